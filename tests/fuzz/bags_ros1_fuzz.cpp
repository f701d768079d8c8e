/**
 * Any bytes as a bag of ROS 1. The first byte chooses between the rest behind the magic number, and the rest as the
 * data of a chunk whose lengths are right. fuzz options: -max_len=512
 */
#include "readBag.h"

using namespace scanloom;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0) return 0;
  const Bytes rest(data + 1, size - 1);
  std::vector<std::uint8_t> file;
  append(file, "#ROSBAG V2.0\n");
  if (data[0] % 2 == 1)
  {
    const std::string op = "op=\x05", compression = "compression=none";
    appendNumber(file, static_cast<std::uint32_t>(8 + op.size() + compression.size()));
    for (const std::string& field : {op, compression})
    {
      appendNumber(file, static_cast<std::uint32_t>(field.size()));
      append(file, field);
    }
    appendNumber(file, static_cast<std::uint32_t>(rest.size()));
  }
  append(file, rest);
  readBag(file);
  return 0;
}
