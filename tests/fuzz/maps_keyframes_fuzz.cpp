/**
 * Any text as keyframes.csv: symmetric, finite covariances, or std::runtime_error. The first byte chooses whether the
 * rest is text, or fields of a row for each byte.
 * fuzz options: -max_len=512
 * fuzz sources: mrpt/maps/KeyframeTable.cpp
 * fuzz libs: scanloom_config
 */
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "MemoryFile.h"
#include "mrpt/maps/KeyframeTable.h"
#include "wordsOf.h"

using namespace scanloom;

namespace
{
const std::string kRow = "1750000000000000000,0,1,0,1,0,0,1,0,0,0,1,0,0,0,0,1,0,0,0,0,0,1";

const std::array<std::string, 16> kWords{",", "\n",    "0",     "1", "-",  "1e-9", "nan",      "inf",
                                         "e", "1e308", "stamp", ".", kRow, "0,0,", "1,0,1,0,", kRow + "\n"};
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const FuzzFolder folder;
  static const MemoryFile table(folder, "keyframes.csv");
  if (size == 0) return 0;
  const std::string rest(data + 1, data + size);
  const std::string text = "stamp_ns,begins_map,c00\n" + (data[0] & 1 ? wordsOf(rest, kWords) : rest);
  mayThrow<std::runtime_error>(
      [&]
      {
        for (const KeyframeRow& row : readKeyframeTable(table.holding(text)))
          require(row.covariance.allFinite() && row.covariance == row.covariance.transpose());
      });
  return 0;
}
