/**
 * Any bytes as the packet of a cloud, with the magic number mended: what is called sound can be decoded, or throws
 * std::out_of_range. fuzz options: -max_len=512
 */
#include <algorithm>

#include "input/lidar/CloudPacket.h"
#include "require.h"

using namespace scanloom;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const auto decoder = makeCloudDecoder({10, 16}, Rigid::identity());
  static const std::vector<std::uint8_t> kEmpty = cloudPacket({});
  if (size < kEmpty.size()) return 0;
  std::vector<std::uint8_t> packet(data, data + size);
  std::copy(kEmpty.begin(), kEmpty.begin() + 8, packet.begin());
  if (decoder->kind(packet) != PacketKind::Lidar) return 0;
  std::vector<MeasurementBlock> blocks;
  decoder->readBlocks(packet, blocks);
  PointCloud points;
  for (const MeasurementBlock& block : blocks)
    mayThrow<std::out_of_range>([&] { decoder->appendPoints(packet, block.index, 0, 0, points); });
  for (std::size_t i = 0; i < points.size(); ++i) require(points.t[i] >= 0);
  return 0;
}
