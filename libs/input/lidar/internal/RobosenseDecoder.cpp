#include "input/lidar/internal/RobosenseDecoder.h"

#include "base/core/Angle.h"
#include "input/lidar/internal/ringsFromTheTop.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kRadiansPerAzimuth = 2 * M_PI / kRobosenseTurn;

std::vector<Beam> robosenseBeams(const RobosenseMetadata& m)
{
  std::vector<Beam> beams;
  for (std::size_t i = 0; i < m.angles.vertical.size(); ++i)
    beams.push_back(Beam{-m.angles.azimuth[i] * kDegree, m.angles.vertical[i] * kDegree,
                         Eigen::Vector3d(m.model->lens_m, 0, m.model->lens_z_m), 0});
  return beams;
}

int robosenseColumn(double azimuth, int columns)
{
  return std::clamp(static_cast<int>(azimuth * columns / kRobosenseTurn), 0, columns - 1);
}

LidarDescription describeRobosense(const RobosenseMetadata& m, const Rigid& body_T_sensor)
{
  LidarDescription d;
  d.model = m.model->name;
  d.serial = m.serial;
  d.channels = m.model->channels;
  d.frame_rate = m.rpm / 60;
  d.columns_per_frame = static_cast<int>(std::lround(1 / (d.frame_rate * seconds(m.model->sequence))));
  d.columns_per_packet = static_cast<int>(kRobosenseReadings) / (m.model->channels * m.returns);
  d.first_column = robosenseColumn(100 * m.first_azimuth_deg, d.columns_per_frame);
  d.last_column = robosenseColumn(100 * m.last_azimuth_deg, d.columns_per_frame);
  d.returns = m.returns;
  d.frame_id_modulus = 1;
  d.lidar_port = m.lidar_port;
  d.body_T_sensor = body_T_sensor;
  d.clock = "UTC";
  d.numbering = Numbering::Stamps;
  d.fixed_block_period = m.model->sequence;
  return d;
}
}  // namespace

RobosenseDecoder::RobosenseDecoder(RobosenseMetadata metadata, const Rigid& body_T_sensor)
  : metadata_(std::move(metadata)),
    description_(describeRobosense(metadata_, body_T_sensor)),
    beams_(robosenseBeams(metadata_), body_T_sensor),
    ring_(ringsFromTheTop(metadata_.angles.vertical))
{
}

RobosensePacket RobosenseDecoder::view(Bytes packet) const
{
  return {packet, *metadata_.model, metadata_.returns, metadata_.rpm};
}

PacketKind RobosenseDecoder::kindByHeader(Bytes packet) const
{
  if (packet.size() != kRobosensePacketBytes) return PacketKind::Malformed;
  if (isRobosenseDeviceInfo(packet)) return PacketKind::Other;
  const RobosensePacket view = this->view(packet);
  if (!view.isSound()) return PacketKind::Malformed;
  return view.isOfModel() ? PacketKind::Lidar : PacketKind::Foreign;
}

std::uint16_t RobosenseDecoder::column(double azimuth) const
{
  return static_cast<std::uint16_t>(robosenseColumn(azimuth, description_.columns_per_frame));
}

void RobosenseDecoder::readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const
{
  const RobosensePacket view = this->view(packet);
  const std::optional<Timestamp> stamp = view.stamp();
  blocks.clear();
  blocks.reserve(view.firings());
  for (std::size_t i = 0; i < view.firings(); ++i)
  {
    const RobosenseFiring firing = view.firing(i);
    MeasurementBlock block;
    block.stamp = stamp.value_or(Timestamp{}) + firing.after_stamp;
    block.measurement_id = column(firing.azimuth);
    block.index = static_cast<std::uint16_t>(i);
    block.valid = firing.valid && stamp.has_value();
    blocks.push_back(block);
  }
}

void RobosenseDecoder::appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                                    PointCloud& points) const
{
  const RobosensePacket view = this->view(packet);
  if (block_index >= view.firings()) throw std::out_of_range("appendPoints: the packet has no such block");
  const RobosenseFiring firing = view.firing(block_index);
  if (!firing.valid || !view.stamp()) return;

  // Encoder angles count counter-clockwise.
  const double th = -firing.azimuth * kRadiansPerAzimuth, rate = -view.rate() * kRadiansPerAzimuth;
  const double cos_th = std::cos(th), sin_th = std::sin(th);
  const std::uint16_t column = this->column(firing.azimuth);
  const PointRoom to = points.room(2 * ring_.size());
  std::size_t n = 0;
  const auto write = [&](std::size_t channel, RobosenseReading reading)
  {
    const std::int32_t shot = metadata_.model->shots[channel];
    const double on = rate * shot, shrunk = 1 - 0.5 * on * on;  // below 0.015 rad: two terms give 6e-7
    const double range_mm = reading.counts * view.unitMm();
    const Eigen::Vector3f point =
        beams_.project(static_cast<Eigen::Index>(channel), static_cast<float>(cos_th * shrunk - sin_th * on),
                       static_cast<float>(sin_th * shrunk + cos_th * on), static_cast<float>(range_mm));
    to.x[n] = point.x();
    to.y[n] = point.y();
    to.z[n] = point.z();
    to.intensity[n] = reading.reflectivity;
    to.t[n] = t + shot;
    to.ring[n] = ring_[channel];
    to.column[n] = column;
    to.sensor_id[n] = sensor_id;
    to.range[n] = static_cast<std::uint32_t>(std::lround(range_mm));
    to.signal[n] = to.near_ir[n] = 0;
    ++n;
  };
  for (std::size_t channel = 0; channel < ring_.size(); ++channel)
    if (const RobosenseReading first = view.reading(block_index, channel, 0); first.counts > 0) write(channel, first);
  for (std::size_t channel = 0; metadata_.returns == 2 && channel < ring_.size(); ++channel)
  {
    const RobosenseReading second = view.reading(block_index, channel, 1);
    if (second.counts > 0 && second.counts != view.reading(block_index, channel, 0).counts) write(channel, second);
  }
  points.grow(n);
}
}  // namespace scanloom
