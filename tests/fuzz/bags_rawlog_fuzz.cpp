/**
 * A rawlog of stock MRPT with a damaged turn of packets between two sound ones, as a bag. The first byte chooses what
 * the rest is: changes of bytes, three of each (where, 16 bits; what), or all that follows the class's name. Few runs
 * by default: MRPT's exceptions take milliseconds.
 * fuzz options: -max_len=256 -malloc_limit_mb=200 -rss_limit_mb=1024 -runs=4000
 */
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/serialization/CSerializable.h>

#include "readBag.h"

using namespace scanloom;
using Buffer = std::vector<std::uint8_t>;

namespace
{
constexpr std::size_t kName = 1;  // byte of its length before it

Buffer soundTurn()
{
  mrpt::obs::CObservationVelodyneScan scan;
  scan.sensorLabel = "front";
  scan.scan_packets.resize(2);
  scan.point_cloud.x = scan.point_cloud.y = scan.point_cloud.z = {1, 2, 3};
  Buffer bytes;
  mrpt::serialization::ObjectToOctetVector(&scan, bytes);
  return bytes;
}

Buffer changed(Buffer object, Bytes input)
{
  for (std::size_t at = 0; at + 3 <= input.size(); at += 3)
    object[load<std::uint16_t>(input, at) % object.size()] = input[at + 2];
  return object;
}

Buffer replaced(Buffer object, Bytes input)
{
  object.resize(kName + (object[0] & 0x7FU));
  append(object, input);
  return object;
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const Buffer sound = soundTurn();
  if (size == 0) return 0;
  const Bytes input(data + 1, size - 1);
  Buffer rawlog = sound;
  append(rawlog, data[0] % 4 == 0 ? replaced(sound, input) : changed(sound, input));
  append(rawlog, sound);
  readBag(rawlog);
  return 0;
}
