#include "input/lidar/internal/VelodyneDecoder.h"

#include "base/core/Angle.h"
#include "input/lidar/internal/ringsFromTheTop.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kRadiansPerCount = 2 * M_PI / kVelodyneTurn;

std::vector<Beam> beamsOf(const VelodyneMetadata& m)
{
  std::vector<Beam> beams;
  for (std::size_t i = 0; i < m.vertical_deg.size(); ++i)
    beams.push_back(Beam{-m.azimuth_offset_deg[i] * kDegree, m.vertical_deg[i] * kDegree,
                         Eigen::Vector3d(0, 0, 1e-3 * m.vertical_offset_mm[i]), 0});
  return beams;
}

int columnOf(double azimuth, int columns)
{
  return std::clamp(static_cast<int>(azimuth * columns / kVelodyneTurn), 0, columns - 1);
}

LidarDescription describe(const VelodyneMetadata& m, const Rigid& body_T_sensor)
{
  LidarDescription d;
  d.model = m.model->name;
  d.serial = m.serial;
  d.channels = m.model->channels;
  d.frame_rate = m.rpm / 60;
  d.columns_per_frame = static_cast<int>(std::lround(1 / (d.frame_rate * seconds(m.model->sequence))));
  d.columns_per_packet = static_cast<int>(m.model->sequencesPerPacket()) / m.returns;
  d.first_column = columnOf(100 * m.first_azimuth_deg, d.columns_per_frame);
  d.last_column = columnOf(100 * m.last_azimuth_deg, d.columns_per_frame);
  d.returns = m.returns;
  d.frame_id_modulus = 1;
  d.lidar_port = m.lidar_port;
  d.body_T_sensor = body_T_sensor;
  d.clock = "TOP_OF_HOUR";
  d.stamp_modulus = std::chrono::hours{1};
  d.numbering = Numbering::Stamps;
  d.fixed_block_period = m.model->sequence;
  return d;
}
}  // namespace

VelodyneDecoder::VelodyneDecoder(VelodyneMetadata metadata, const Rigid& body_T_sensor)
  : metadata_(std::move(metadata)),
    description_(describe(metadata_, body_T_sensor)),
    beams_(beamsOf(metadata_), body_T_sensor),
    ring_(ringsFromTheTop(metadata_.vertical_deg))
{
}

PacketKind VelodyneDecoder::kindByHeader(Bytes packet) const
{
  if (packet.size() == kVelodynePositionBytes) return PacketKind::Other;
  if (packet.size() != kVelodynePacketBytes) return PacketKind::Malformed;
  const VelodynePacket view = this->view(packet);
  const bool is_early =
      metadata_.early_product_id != 0 && view.productId() == metadata_.early_product_id && view.turnsAsSet();
  if (view.productId() != metadata_.product_id && !is_early) return PacketKind::Foreign;
  const bool as_set = view.hasTwoReturns() == (metadata_.returns == 2);
  return as_set && view.isSound() ? PacketKind::Lidar : PacketKind::Malformed;
}

std::uint16_t VelodyneDecoder::column(double azimuth) const
{
  return static_cast<std::uint16_t>(columnOf(azimuth, description_.columns_per_frame));
}

void VelodyneDecoder::readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const
{
  const VelodynePacket view = this->view(packet);
  const Duration hour = description_.stamp_modulus;
  const Duration first_shot = std::chrono::microseconds{view.microseconds()} + metadata_.model->first_shot;
  blocks.clear();
  blocks.reserve(view.sequences());
  for (std::size_t i = 0; i < view.sequences(); ++i)
  {
    const VelodyneSequence sequence = view.sequence(i);
    MeasurementBlock block;
    block.stamp = Timestamp{(first_shot + sequence.after_first + hour) % hour};  // some counters go on past the hour
    block.measurement_id = column(sequence.azimuth);
    block.index = static_cast<std::uint16_t>(i);
    block.valid = sequence.valid;
    blocks.push_back(block);
  }
}

void VelodyneDecoder::appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                                   PointCloud& points) const
{
  const VelodynePacket view = this->view(packet);
  if (block_index >= view.sequences()) throw std::out_of_range("appendPoints: the packet has no such block");
  const VelodyneSequence sequence = view.sequence(block_index);
  if (!sequence.valid) return;

  // Encoder angles count counter-clockwise.
  const double th = -sequence.azimuth * kRadiansPerCount, rate = -view.rate() * kRadiansPerCount;
  const double cos_th = std::cos(th), sin_th = std::sin(th);
  const std::uint16_t column = this->column(sequence.azimuth);
  const PointRoom to = points.room(2 * ring_.size());
  std::size_t n = 0;
  const auto write = [&](std::size_t laser, VelodyneReading reading)
  {
    const Duration shot = metadata_.model->shotTime(static_cast<int>(laser));
    const double on = rate * static_cast<double>(shot.count());  // below 0.01 rad: two terms give 2e-7
    const double shrunk = 1 - 0.5 * on * on;
    const Eigen::Vector3f point =
        beams_.project(static_cast<Eigen::Index>(laser), static_cast<float>(cos_th * shrunk - sin_th * on),
                       static_cast<float>(sin_th * shrunk + cos_th * on), static_cast<float>(reading.range_mm));
    to.x[n] = point.x();
    to.y[n] = point.y();
    to.z[n] = point.z();
    to.intensity[n] = reading.reflectivity;
    to.t[n] = t + static_cast<std::int32_t>(shot.count());
    to.ring[n] = ring_[laser];
    to.column[n] = column;
    to.sensor_id[n] = sensor_id;
    to.range[n] = reading.range_mm;
    to.signal[n] = to.near_ir[n] = 0;
    ++n;
  };
  for (std::size_t laser = 0; laser < ring_.size(); ++laser)
    if (const VelodyneReading first = view.reading(block_index, laser, 0); first.range_mm > 0) write(laser, first);
  for (std::size_t laser = 0; view.hasTwoReturns() && laser < ring_.size(); ++laser)
  {
    const VelodyneReading second = view.reading(block_index, laser, 1);
    if (second.range_mm > 0 && second.range_mm != view.reading(block_index, laser, 0).range_mm) write(laser, second);
  }
  points.grow(n);
}
}  // namespace scanloom
