#include "input/lidar/OusterEncoder.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
namespace
{
using Packet = std::vector<std::uint8_t>;

void storeField(Packet& packet, ByteField f, std::uint64_t value)
{
  if (f.count > 0) std::memcpy(packet.data() + f.offset, &value, f.count);
}

void storeVector(Packet& packet, std::size_t offset, const Eigen::Vector3d& v)
{
  for (int axis = 0; axis < 3; ++axis)
    store(packet, offset + 4 * static_cast<std::size_t>(axis), static_cast<float>(v[axis]));
}

std::uint64_t unsignedNanoseconds(Timestamp t) { return static_cast<std::uint64_t>(nanoseconds(t)); }

/** The range, or 0 if the field is too narrow for it: a truncated range would be a wrong point. */
std::uint32_t withinReach(std::uint32_t range_mm, BitField f) { return range_mm <= f.mask() << f.shift ? range_mm : 0; }

void seal(Packet& packet, OusterHeader header)
{
  if (!OusterLayout::hasCrc(header)) return;
  const std::size_t end = packet.size() - kOusterCrcBytes;
  store(packet, end, crc64(Bytes(packet).slice(0, end)));
}
}  // namespace

OusterEncoder::OusterEncoder(const OusterMetadata& metadata)
  : metadata_(parseOusterMetadata(toJson(metadata), "OusterEncoder")), layout_(layoutOf(metadata_))
{
}

void OusterEncoder::writeHeader(Packet& packet, OusterHeader header, std::uint64_t type, std::uint32_t frame_id) const
{
  if (header == OusterHeader::None) return;
  const OusterHeaderFields& fields = headerFields(header);
  storeField(packet, fields.type, type);
  storeField(packet, fields.frame_id, frame_id % fields.frame_id_modulus);
  storeField(packet, fields.init_id, metadata_.init_id.value_or(0));
  storeField(packet, fields.serial, serialNumber(metadata_).value_or(0));
}

void OusterEncoder::writeChannel(Packet& packet, std::size_t offset, const OusterReading& reading) const
{
  const OusterProfile& profile = *layout_.profile;
  const auto write = [&](OusterField field, std::uint32_t value)
  {
    if (profile[field].present()) writeField(packet, offset, profile[field], value);
  };
  write(OusterField::Range, withinReach(reading.first.range_mm, profile[OusterField::Range]));
  write(OusterField::Reflectivity, reading.first.reflectivity);
  write(OusterField::Signal, reading.first.signal);
  write(OusterField::Range2, withinReach(reading.second.range_mm, profile[OusterField::Range2]));
  write(OusterField::Reflectivity2, reading.second.reflectivity);
  write(OusterField::Signal2, reading.second.signal);
  write(OusterField::NearIr, reading.near_ir);
}

void OusterEncoder::writeColumn(Packet& packet, std::size_t offset, const OusterColumn& column) const
{
  if (!column.readings.empty() && column.readings.size() != layout_.channels)
    throw std::invalid_argument(fmt::format("OusterEncoder: a column has {} readings, but the sensor has {} channels",
                                            column.readings.size(), layout_.channels));
  store(packet, offset + kOusterColumnStamp, unsignedNanoseconds(column.stamp));
  store(packet, offset + kOusterColumnMeasurementId, column.measurement_id);
  if (layout_.isLegacy())
  {
    const std::uint32_t ticks =
        column.measurement_id * kOusterEncoderTicks / static_cast<std::uint32_t>(metadata_.columns_per_frame);
    store(packet, offset + kOusterColumnFrameIdOrStatus, static_cast<std::uint16_t>(column.frame_id));
    store(packet, offset + kOusterColumnEncoder, ticks);
    store(packet, offset + layout_.columnBytes() - layout_.columnFooterBytes(), column.valid ? 0xFFFFFFFFu : 0u);
  }
  else
    store(packet, offset + kOusterColumnFrameIdOrStatus, static_cast<std::uint16_t>(column.valid ? 1 : 0));

  offset += layout_.columnHeaderBytes();
  for (std::size_t i = 0; i < column.readings.size(); ++i)
    writeChannel(packet, offset + i * layout_.profile->channel_bytes, column.readings[i]);
}

Packet OusterEncoder::lidarPacket(const std::vector<OusterColumn>& columns) const
{
  if (columns.size() != layout_.columns)
    throw std::invalid_argument(
        fmt::format("OusterEncoder: {} columns, but a packet has {}", columns.size(), layout_.columns));
  Packet packet(layout_.lidarPacketBytes());
  writeHeader(packet, layout_.lidar_header, kOusterLidarType, columns.front().frame_id);
  for (std::size_t i = 0; i < columns.size(); ++i) writeColumn(packet, layout_.columnOffset(i), columns[i]);
  seal(packet, layout_.lidar_header);
  return packet;
}

std::size_t OusterEncoder::imuSamplesPerPacket() const
{
  switch (layout_.imu_profile)
  {
    case OusterImuProfile::Legacy:
      return 1;
    case OusterImuProfile::Off:
      return 0;
    case OusterImuProfile::Accel32Gyro32Nmea:
      break;
  }
  return layout_.imu_measurements;
}

Packet OusterEncoder::imuPacket(const std::vector<ImuSample>& samples, std::uint32_t frame_id) const
{
  if (samples.size() != imuSamplesPerPacket() || samples.empty())
    throw std::invalid_argument(
        fmt::format("OusterEncoder: {} IMU samples, but a packet has {}", samples.size(), imuSamplesPerPacket()));
  Packet packet(layout_.imuPacketBytes());
  if (layout_.imu_profile == OusterImuProfile::Legacy)
  {
    namespace at = ouster_legacy_imu;
    for (const std::size_t stamp : {at::kSystemStamp, at::kAccelStamp, at::kGyroStamp})
      store(packet, stamp, unsignedNanoseconds(samples[0].stamp));
    storeVector(packet, at::kAccel, samples[0].accel / kOusterStandardGravity);
    storeVector(packet, at::kGyro, samples[0].gyro / kOusterDegree);
    return packet;
  }

  namespace at = ouster_accel_gyro;
  writeHeader(packet, layout_.imu_header, kOusterImuType, frame_id);
  std::size_t offset = headerFields(layout_.imu_header).bytes + at::kNmeaBytes;
  for (std::size_t i = 0; i < samples.size(); ++i, offset += at::kMeasurementBytes)
  {
    store(packet, offset + at::kStamp, unsignedNanoseconds(samples[i].stamp));
    store(packet, offset + at::kMeasurementId, static_cast<std::uint16_t>(i));
    store(packet, offset + at::kStatus, std::uint16_t{1});
    storeVector(packet, offset + at::kAccel, samples[i].accel);
    storeVector(packet, offset + at::kGyro, samples[i].gyro);
  }
  seal(packet, layout_.imu_header);
  return packet;
}
}  // namespace scanloom
