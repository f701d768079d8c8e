/** Any bytes as a packet of any profile: what kind() accepts is decoded, everything else at worst ends in
 * std::out_of_range. */
#include <memory>
#include <stdexcept>

#include "../lidar/simpleMetadata.h"
#include "lidar/FrameFields.h"

using namespace scanloom;

namespace
{
std::vector<std::unique_ptr<OusterDecoder>> everyDecoder()
{
  std::vector<std::unique_ptr<OusterDecoder>> decoders;
  for (const OusterProfile& profile : kOusterProfiles)
    for (const OusterImuProfile imu : {OusterImuProfile::Legacy, OusterImuProfile::Accel32Gyro32Nmea})
    {
      OusterMetadata m = simpleMetadata(std::string(profile.name), 4, 2);
      m.imu_profile = imu;
      m.imu_measurements_per_packet = 2;
      decoders.push_back(std::make_unique<OusterDecoder>(m, Rigid::identity()));
    }
  return decoders;
}

void decodeImu(const OusterDecoder& decoder, Bytes packet)
{
  decoder.header(packet);
  for (const ImuSample& sample : decoder.imuSamples(packet))
    if (!sample.accel.allFinite() || !sample.gyro.allFinite()) __builtin_trap();
}

void decodeLidar(const OusterDecoder& decoder, Bytes packet)
{
  decoder.header(packet);
  std::vector<MeasurementBlock> blocks;
  decoder.readBlocks(packet, blocks);
  PointCloud points;
  for (const MeasurementBlock& block : blocks) decoder.appendPoints(packet, block.index, 0, 0, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.range[i] == 0 || !points.position(i).allFinite()) __builtin_trap();

  FrameFields frames(decoder);
  frames.push(packet);
}

void refuse(void (*decode)(const OusterDecoder&, Bytes), const OusterDecoder& decoder, Bytes packet)
{
  try
  {
    decode(decoder, packet);
  }
  catch (const std::out_of_range&)
  {
  }
}
}  // namespace

/** The first byte chooses the decoder, the second whether the size is made to fit; the rest is the packet. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const auto decoders = everyDecoder();
  if (size < 2) return 0;
  const OusterDecoder& decoder = *decoders[data[0] % decoders.size()];
  std::vector<std::uint8_t> packet(data + 2, data + size);
  if (data[1] & 1) packet.resize(decoder.layout().lidarPacketBytes());
  if (data[1] & 2) packet.resize(decoder.layout().imuPacketBytes());

  switch (decoder.kind(packet))
  {
    case PacketKind::Lidar:
      decodeLidar(decoder, packet);
      break;
    case PacketKind::Imu:
      decodeImu(decoder, packet);
      break;
    default:
      refuse(&decodeLidar, decoder, packet);
      refuse(&decodeImu, decoder, packet);
  }
  return 0;
}
