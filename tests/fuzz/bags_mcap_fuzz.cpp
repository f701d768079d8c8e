/**
 * Any bytes as an MCAP file. The first byte chooses between the rest behind the magic number, and the rest as the
 * records of a chunk whose lengths are right. fuzz options: -max_len=512
 */
#include "readBag.h"

using namespace scanloom;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0) return 0;
  const Bytes rest(data + 1, size - 1);
  std::vector<std::uint8_t> file;
  append(file, "\x89MCAP0\r\n");
  if (data[0] % 2 == 1)
  {
    constexpr std::uint64_t kFields = 8 + 8 + 8 + 4 + 4 + 8;
    appendNumber(file, std::uint8_t{6});
    appendNumber(file, std::uint64_t{kFields + rest.size()});
    for (const std::uint64_t field : {std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{rest.size()}})
      appendNumber(file, field);
    appendNumber(file, std::uint32_t{0});
    appendNumber(file, std::uint32_t{0});
    appendNumber(file, std::uint64_t{rest.size()});
  }
  append(file, rest);
  readBag(file);
  return 0;
}
