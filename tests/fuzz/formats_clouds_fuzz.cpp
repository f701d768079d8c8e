/**
 * Any bytes are either positions or std::invalid_argument. The first byte chooses a beginning that chance would not
 * find, or none. fuzz options: -max_len=512
 */
#include "base/formats/internal/PcdReader.h"
#include "base/formats/internal/PlyReader.h"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "require.h"

using namespace scanloom;

namespace
{
constexpr const char* kPlyProperties =
    "element vertex 3\nproperty float x\nproperty double y\nproperty float z\nproperty uchar ring\nend_header\n";
constexpr const char* kPcdFields = "FIELDS x y z i\nSIZE 4 8 4 2\nTYPE F F F U\nCOUNT 1 1 1 2\nPOINTS 3\nDATA ";

std::string plyOf(const std::string& format, const char* properties)
{
  return "ply\nformat " + format + " 1.0\n" + properties;
}

const std::array<std::string, 12> kBeginnings{plyOf("ascii", kPlyProperties),
                                              plyOf("binary_little_endian", kPlyProperties),
                                              plyOf("binary_big_endian", kPlyProperties),
                                              plyOf("ascii", "element vertex "),
                                              plyOf("binary_little_endian", "element vertex 2\nproperty "),
                                              "",
                                              std::string(kPcdFields) + "ascii\n",
                                              std::string(kPcdFields) + "binary\n",
                                              std::string(kPcdFields) + "binary_compressed\n",
                                              "FIELDS x y z\nSIZE ",
                                              "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nPOINTS ",
                                              ""};
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0) return 0;
  const std::size_t choice = data[0] % kBeginnings.size();
  std::vector<std::uint8_t> file(kBeginnings[choice].begin(), kBeginnings[choice].end());
  file.insert(file.end(), data + 1, data + size);
  mayThrow<std::invalid_argument>(
      [&]
      {
        const auto positions = (choice < kBeginnings.size() / 2 ? plyPoints(file) : pcdPoints(file)).positions;
        constexpr std::size_t kLongestCopy = 264;  // that a byte of compressed data can stand for
        require(positions.size() <= kLongestCopy * file.size());
      });
  return 0;
}
