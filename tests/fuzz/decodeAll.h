/** Decodes a packet of a lidar of stamps, and checks what must hold of any packet that kind() accepts. */
#pragma once
#include <memory>
#include <stdexcept>
#include <vector>

#include "input/lidar/internal/StampedDecoder.h"
#include "require.h"

namespace scanloom
{
/** `is_chosen`: whether to make the points of a block. They take most of the time, and blocks are alike. */
template <typename IsChosen>
void decodeAll(const PacketDecoder& decoder, Bytes packet, IsChosen&& is_chosen)
{
  static std::vector<MeasurementBlock> blocks;
  static PointCloud points;
  const LidarDescription& d = decoder.description();
  const Duration end = d.stamp_modulus > Duration{0} ? d.stamp_modulus : Duration{std::int64_t{1} << 62};
  decoder.header(packet);
  decoder.readBlocks(packet, blocks);
  points.clear();
  for (const MeasurementBlock& block : blocks)
  {
    require(block.measurement_id < d.columns_per_frame);
    require(!block.valid || (block.stamp >= Timestamp{} && block.stamp < Timestamp{end}));
    // The order holds but where stamps begin anew.
    const Duration after_first = block.stamp - blocks.front().stamp;
    require(!block.valid || after_first >= Duration{0} || (d.stamp_modulus > Duration{0} && after_first < -end / 2));
    if (!is_chosen(block.index, blocks.size())) continue;
    const std::size_t before = points.size();
    decoder.appendPoints(packet, block.index, 0, 0, points);
    require(block.valid || points.size() == before);
    require(points.size() - before <= static_cast<std::size_t>(d.channels * d.returns));
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    require(points.range[i] > 0 && points.ring[i] < d.channels && points.t[i] >= 0 &&
            Duration{points.t[i]} < d.fixed_block_period && points.position(i).allFinite());
}

/** Whatever its bytes are, no decoder does worse than to throw std::out_of_range. */
inline void refuse(const PacketDecoder& decoder, Bytes packet)
{
  mayThrow<std::out_of_range>([&] { decodeAll(decoder, packet, [](std::size_t, std::size_t) { return true; }); });
}

/** Of every model with one and with two returns, all angles 0. */
template <typename Metadata, typename Models>
std::vector<Metadata> everyLidar(const Models& models)
{
  std::vector<Metadata> lidars;
  for (const auto& model : models)
    for (const int returns : {1, 2})
    {
      Metadata& metadata = lidars.emplace_back();
      metadata.model = &model;
      metadata.returns = returns;
      metadata.angles.vertical.resize(static_cast<std::size_t>(model.channels));
      metadata.angles.azimuth = metadata.angles.vertical;
    }
  return lidars;
}

/** A packet that kind() accepts is decoded; one of fewer bytes than its model's is refused. */
inline void decodeOrRefuse(const PacketDecoder& decoder, Bytes packet, std::size_t least_bytes)
{
  if (decoder.kind(packet) == PacketKind::Lidar)
    decodeAll(decoder, packet, [](std::size_t, std::size_t) { return true; });
  else if (packet.size() < least_bytes)
    refuse(decoder, packet);
}

template <typename Lidars, typename Make>
std::vector<std::unique_ptr<PacketDecoder>> decodersOf(const Lidars& lidars, Make&& make)
{
  std::vector<std::unique_ptr<PacketDecoder>> decoders;
  for (const auto& metadata : lidars) decoders.push_back(make(metadata, Rigid::identity()));
  return decoders;
}
}  // namespace scanloom
