#include "input/lidar/internal/HesaiDecoder.h"

#include "base/core/Angle.h"
#include "input/lidar/internal/ringsFromTheTop.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr std::size_t kPositionBytes = 512;  // position packets: GPS sentence and housekeeping, on another port

std::vector<Beam> beamsOf(const HesaiMetadata& m)
{
  std::vector<Beam> beams;
  for (std::size_t i = 0; i < m.vertical_deg.size(); ++i)
    beams.push_back(Beam{-m.azimuth_offset_deg[i] * kDegree, m.vertical_deg[i] * kDegree, Eigen::Vector3d::Zero(), 0});
  return beams;
}

int columnOf(double azimuth, int columns)
{
  return std::clamp(static_cast<int>(azimuth * columns / kHesaiTurn), 0, columns - 1);
}

LidarDescription describe(const HesaiMetadata& m, const Rigid& body_T_sensor)
{
  LidarDescription d;
  d.model = m.model->name;
  d.serial = m.serial;
  d.channels = m.model->channels;
  d.frame_rate = m.rpm / 60;
  d.columns_per_frame = static_cast<int>(std::lround(1 / (d.frame_rate * seconds(m.model->block))));
  d.columns_per_packet = m.model->blocks / m.returns;
  d.first_column = columnOf(100 * m.first_azimuth_deg, d.columns_per_frame);
  d.last_column = columnOf(100 * m.last_azimuth_deg, d.columns_per_frame);
  d.returns = m.returns;
  d.frame_id_modulus = 1;
  d.lidar_port = m.lidar_port;
  d.body_T_sensor = body_T_sensor;
  d.clock = "UTC";
  d.numbering = Numbering::Stamps;
  d.fixed_block_period = m.model->block;
  return d;
}
}  // namespace

HesaiDecoder::HesaiDecoder(HesaiMetadata metadata, const Rigid& body_T_sensor)
  : metadata_(std::move(metadata)),
    description_(describe(metadata_, body_T_sensor)),
    beams_(beamsOf(metadata_), body_T_sensor),
    ring_(ringsFromTheTop(metadata_.vertical_deg))
{
}

PacketKind HesaiDecoder::kindByHeader(Bytes packet) const
{
  const HesaiModel& model = *metadata_.model;
  if (packet.size() == kPositionBytes) return PacketKind::Other;
  if (packet.size() != model.packetBytes() && packet.size() != model.packetBytes() + model.optional_bytes)
    return PacketKind::Malformed;
  const HesaiPacket view(packet, model);
  if (!view.isSound()) return PacketKind::Malformed;
  if (!view.isOfModel()) return PacketKind::Foreign;
  return view.returns() == metadata_.returns ? PacketKind::Lidar : PacketKind::Malformed;
}

std::uint16_t HesaiDecoder::column(int azimuth) const
{
  return static_cast<std::uint16_t>(columnOf(azimuth, description_.columns_per_frame));
}

void HesaiDecoder::readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const
{
  const HesaiPacket view(packet, *metadata_.model);
  const std::optional<Timestamp> stamp = view.stamp();
  blocks.clear();
  blocks.reserve(view.firings());
  for (std::size_t i = 0; i < view.firings(); ++i)
  {
    const HesaiFiring firing = view.firing(i);
    MeasurementBlock block;
    if (stamp) block.stamp = *stamp + firing.after_stamp;
    block.measurement_id = column(firing.azimuth);
    block.index = static_cast<std::uint16_t>(i);
    block.valid = firing.valid && stamp.has_value();
    blocks.push_back(block);
  }
}

void HesaiDecoder::appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                                PointCloud& points) const
{
  const HesaiPacket view(packet, *metadata_.model);
  if (block_index >= view.firings()) throw std::out_of_range("appendPoints: the packet has no such block");
  const HesaiFiring firing = view.firing(block_index);
  if (!firing.valid || !view.stamp()) return;

  // Encoder angles count counter-clockwise from x, azimuths clockwise from y.
  const double th = M_PI / 2 - firing.azimuth * 2 * M_PI / kHesaiTurn;
  const auto cos_th = static_cast<float>(std::cos(th)), sin_th = static_cast<float>(std::sin(th));
  const std::uint16_t column = this->column(firing.azimuth);
  const std::int32_t first_shot = firstHesaiShot(firing.shots, metadata_.model->channels);
  const PointRoom to = points.room(2 * ring_.size());
  std::size_t n = 0;
  const auto write = [&](std::size_t channel, HesaiReading reading)
  {
    const Eigen::Vector3f point =
        beams_.project(static_cast<Eigen::Index>(channel), cos_th, sin_th, static_cast<float>(reading.range_mm));
    to.x[n] = point.x();
    to.y[n] = point.y();
    to.z[n] = point.z();
    to.intensity[n] = reading.reflectivity;
    to.t[n] = t + firing.shots[channel] - first_shot;
    to.ring[n] = ring_[channel];
    to.column[n] = column;
    to.sensor_id[n] = sensor_id;
    to.range[n] = reading.range_mm;
    to.signal[n] = to.near_ir[n] = 0;
    ++n;
  };
  for (std::size_t channel = 0; channel < ring_.size(); ++channel)
    if (const HesaiReading first = view.reading(block_index, channel, 0); first.range_mm > 0) write(channel, first);
  for (std::size_t channel = 0; view.returns() == 2 && channel < ring_.size(); ++channel)
  {
    const HesaiReading second = view.reading(block_index, channel, 1);
    if (second.range_mm > 0 && second.range_mm != view.reading(block_index, channel, 0).range_mm)
      write(channel, second);
  }
  points.grow(n);
}
}  // namespace scanloom
