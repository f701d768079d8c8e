/** What decoders make of packets, in one call. */
#pragma once
#include "input/lidar/PacketDecoder.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace scanloom
{
inline std::vector<MeasurementBlock> blocksOf(const PacketDecoder& decoder, Bytes packet)
{
  std::vector<MeasurementBlock> blocks;
  decoder.readBlocks(packet, blocks);
  return blocks;
}

inline PointCloud pointsOf(const PacketDecoder& decoder, Bytes packet, std::size_t block)
{
  PointCloud points;
  decoder.appendPoints(packet, block, 0, 0, points);
  return points;
}

inline PointCloud everyPoint(const PacketDecoder& decoder, const std::vector<std::vector<std::uint8_t>>& packets)
{
  PointCloud cloud;
  for (const auto& packet : packets)
    for (const MeasurementBlock& block : blocksOf(decoder, packet))
      decoder.appendPoints(packet, block.index, 0, 0, cloud);
  return cloud;
}

inline std::vector<Eigen::Vector3f> positionsOf(const PointCloud& cloud)
{
  std::vector<Eigen::Vector3f> positions;
  for (std::size_t i = 0; i < cloud.size(); ++i) positions.push_back(cloud.position(i));
  return positions;
}

/** The row of a brand's table of models. */
template <typename Models>
const typename Models::value_type& modelNamed(const Models& models, std::string_view name)
{
  return *std::find_if(models.begin(), models.end(), [&](const auto& model) { return model.name == name; });
}
}  // namespace scanloom
