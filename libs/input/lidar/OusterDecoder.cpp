#include "input/lidar/OusterDecoder.h"

#include "base/core/Angle.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
constexpr std::uint64_t kNoCrcFirmware22 = 0;
constexpr std::uint64_t kNoCrcFirmware23 = 0xDEADBEEF0000C0DE;

std::uint64_t loadField(Bytes packet, ByteField f)
{
  return f.count == 0 ? 0 : loadUnsigned(packet, f.offset, f.count);
}

LidarDescription describe(const OusterMetadata& m, const Rigid& body_T_sensor)
{
  const OusterLayout layout = layoutOf(m);
  LidarDescription d;
  d.model = m.product_line;
  d.serial = m.serial;
  d.channels = m.channels;
  d.columns_per_frame = m.columns_per_frame;
  d.columns_per_packet = m.columns_per_packet;
  d.first_column = m.first_column;
  d.last_column = m.last_column;
  d.returns = layout.profile->returns();
  d.frame_rate = m.frame_rate;
  d.frame_id_modulus = headerFields(layout.lidar_header).frame_id_modulus;
  d.lidar_port = m.lidar_port;
  d.imu_port = m.imu_port;
  d.sensor_T_imu = rigidFromMillimetres(m.imu_to_sensor_mm);
  d.body_T_sensor = body_T_sensor;
  d.clock = m.timestamp_mode;
  return d;
}

/** What reading packets relies on, for metadata that no parser has checked. */
OusterMetadata checked(OusterMetadata m)
{
  const auto channels = static_cast<std::size_t>(m.channels);
  const auto isColumn = [&m](int column) { return column >= 0 && column < m.columns_per_frame; };
  if (m.channels < 1 || m.beam_altitude_deg.size() != channels || m.beam_azimuth_deg.size() != channels ||
      m.columns_per_packet < 1 || m.columns_per_frame < m.columns_per_packet || !isColumn(m.first_column) ||
      !isColumn(m.last_column) || !(m.frame_rate > 0) || m.imu_measurements_per_packet < 0)
    throw std::invalid_argument("OusterMetadata filled by hand: channels, columns, window, rate or beams are faulty");
  return m;
}

bool crcHolds(Bytes packet)
{
  const std::size_t end = packet.size() - kOusterCrcBytes;
  const auto stored = load<std::uint64_t>(packet, end);
  return stored == kNoCrcFirmware22 || stored == kNoCrcFirmware23 || stored == crc64(packet.slice(0, end));
}

Eigen::Vector3d loadVector(Bytes bytes, std::size_t offset)
{
  return {load<float>(bytes, offset), load<float>(bytes, offset + 4), load<float>(bytes, offset + 8)};
}

/** Leaves out what is not finite, and stamps beyond 62 bits. */
void appendIfUsable(std::vector<ImuSample>& samples, std::uint64_t stamp, const Eigen::Vector3d& gyro,
                    const Eigen::Vector3d& accel)
{
  if (stamp < kOusterEndOfTime && gyro.allFinite() && accel.allFinite())
    samples.push_back({fromNanoseconds(static_cast<std::int64_t>(stamp)), gyro, accel});
}

std::vector<ImuSample> readLegacyImu(Bytes packet)
{
  namespace at = ouster_legacy_imu;
  std::vector<ImuSample> samples;
  appendIfUsable(samples, load<std::uint64_t>(packet, at::kGyroStamp), kOusterDegree * loadVector(packet, at::kGyro),
                 kOusterStandardGravity * loadVector(packet, at::kAccel));
  return samples;
}

std::vector<ImuSample> readAccelGyro(Bytes packet, const OusterLayout& layout)
{
  namespace at = ouster_accel_gyro;
  const std::size_t first = headerFields(layout.imu_header).bytes + at::kNmeaBytes;
  std::vector<ImuSample> samples;
  for (std::size_t i = 0; i < layout.imu_measurements; ++i)
  {
    const Bytes measurement = packet.slice(first + i * at::kMeasurementBytes, at::kMeasurementBytes);
    if ((load<std::uint16_t>(measurement, at::kStatus) & 1) == 0) continue;  // the sensor calls it invalid
    appendIfUsable(samples, load<std::uint64_t>(measurement, at::kStamp), loadVector(measurement, at::kGyro),
                   loadVector(measurement, at::kAccel));
  }
  std::stable_sort(samples.begin(), samples.end(),
                   [](const ImuSample& a, const ImuSample& b) { return a.stamp < b.stamp; });
  return samples;
}
}  // namespace

Rigid rigidFromMillimetres(Eigen::Matrix4d matrix)
{
  matrix.col(3).head<3>() *= 1e-3;
  return Rigid::fromMatrix(matrix);
}

std::vector<Beam> beamsOf(const OusterMetadata& m)
{
  const double x = 1e-3 * m.beam_to_lidar_mm(0, 3), z = 1e-3 * m.beam_to_lidar_mm(2, 3);
  std::vector<Beam> beams;
  for (std::size_t i = 0; i < m.beam_altitude_deg.size(); ++i)
    beams.push_back(
        Beam{-m.beam_azimuth_deg[i] * kDegree, m.beam_altitude_deg[i] * kDegree, {x, 0, z}, std::hypot(x, z)});
  return beams;
}

OusterDecoder::OusterDecoder(OusterMetadata metadata, const Rigid& body_T_sensor, Kernel kernel)
  : metadata_(checked(std::move(metadata))),
    layout_(layoutOf(metadata_)),
    description_(describe(metadata_, body_T_sensor)),
    serial_(serialNumber(metadata_)),
    is_legacy_(layout_.isLegacy()),
    first_column_(layout_.columnOffset(0)),
    column_bytes_(layout_.columnBytes()),
    channels_in_column_(layout_.columnHeaderBytes()),
    angles_(clockwiseColumns(metadata_.columns_per_frame)),
    points_(*layout_.profile,
            BeamTable(beamsOf(metadata_), body_T_sensor * rigidFromMillimetres(metadata_.lidar_to_sensor_mm)), kernel)
{
}

bool OusterDecoder::isForeign(Bytes packet) const
{
  const OusterHeaderFields& fields = headerFields(metadata_.header_type);
  if (!serial_ || packet.size() < fields.bytes) return false;
  const std::uint64_t type = loadField(packet, fields.type), serial = loadField(packet, fields.serial);
  return type >= kOusterLidarType && type <= kOusterZoneType && serial != 0 && serial != *serial_;
}

/** Which of the formats that this sensor sends a packet has, by size and type. */
std::optional<OusterDecoder::Format> OusterDecoder::formatOf(Bytes packet) const
{
  const auto isOfType = [&](OusterHeader header, std::uint64_t type)
  { return header == OusterHeader::None || loadField(packet, headerFields(header).type) == type; };
  if (packet.size() == layout_.lidarPacketBytes() && isOfType(layout_.lidar_header, kOusterLidarType))
    return Format{PacketKind::Lidar, layout_.lidar_header};
  if (!packet.empty() && packet.size() == layout_.imuPacketBytes() && isOfType(layout_.imu_header, kOusterImuType))
    return Format{PacketKind::Imu, layout_.imu_header};
  if (packet.size() == kOusterZonePacketBytes && isOfType(metadata_.header_type, kOusterZoneType))
    return Format{PacketKind::Other, metadata_.header_type};
  return std::nullopt;
}

PacketKind OusterDecoder::kindByHeader(Bytes packet) const
{
  const std::optional<Format> format = formatOf(packet);
  if (format) return format->header != OusterHeader::None && isForeign(packet) ? PacketKind::Foreign : format->kind;
  // Of a size that this sensor never sends: another sensor's on the same port, or damaged.
  return !layout_.isLegacy() && isForeign(packet) ? PacketKind::Foreign : PacketKind::Malformed;
}

bool OusterDecoder::isIntact(Bytes packet) const
{
  const std::optional<Format> format = formatOf(packet);
  return !format || !OusterLayout::hasCrc(format->header) || crcHolds(packet);
}

PacketHeader OusterDecoder::header(Bytes packet) const
{
  const bool is_imu = packet.size() == layout_.imuPacketBytes();
  const OusterHeader type = is_imu ? layout_.imu_header : layout_.lidar_header;
  PacketHeader header;
  if (is_imu && type == OusterHeader::None) return header;

  const OusterHeaderFields& fields = headerFields(type);
  header.frame_id = static_cast<std::uint32_t>(loadField(packet, fields.frame_id));
  if (type == OusterHeader::None) return header;
  header.init_id = static_cast<std::uint32_t>(loadField(packet, fields.init_id));
  const std::uint64_t serial = loadField(packet, fields.serial);
  if (serial != 0) header.serial = serial;
  header.alert_flags = static_cast<std::uint8_t>(loadField(packet, fields.alert_flags));
  header.thermal_status = loadField(packet, fields.thermal_status) & kOusterStatusMask;
  header.shot_limiting_status = loadField(packet, fields.shot_limiting_status) & kOusterStatusMask;
  return header;
}

/** The column's bytes are known to be there. */
MeasurementBlock OusterDecoder::readBlock(const std::uint8_t* column, std::size_t index,
                                          std::uint32_t packet_frame_id) const
{
  const auto read = [column](std::size_t offset, auto value)
  {
    std::memcpy(&value, column + offset, sizeof value);
    return value;
  };
  const auto stamp = read(kOusterColumnStamp, std::uint64_t{});
  const auto frame_id_or_status = read(kOusterColumnFrameIdOrStatus, std::uint16_t{});
  const bool says_valid = ((is_legacy_ ? column[column_bytes_ - 4] : frame_id_or_status) & 1) != 0;
  MeasurementBlock block;
  block.stamp = fromNanoseconds(static_cast<std::int64_t>(stamp));
  block.measurement_id = read(kOusterColumnMeasurementId, std::uint16_t{});
  block.frame_id = is_legacy_ ? frame_id_or_status : packet_frame_id;
  block.index = static_cast<std::uint16_t>(index);
  block.valid = says_valid && block.measurement_id < metadata_.columns_per_frame && stamp < kOusterEndOfTime;
  return block;
}

void OusterDecoder::readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const
{
  const auto frame_id = static_cast<std::uint32_t>(loadField(packet, headerFields(layout_.lidar_header).frame_id));
  const std::uint8_t* column = packet.slice(first_column_, layout_.columns * column_bytes_).data();
  blocks.resize(layout_.columns);
  for (std::size_t i = 0; i < layout_.columns; ++i, column += column_bytes_) blocks[i] = readBlock(column, i, frame_id);
}

void OusterDecoder::appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                                 PointCloud& points) const
{
  if (block_index >= layout_.columns) throw std::out_of_range("appendPoints: the packet has no such block");
  const Bytes column = packet.slice(first_column_ + block_index * column_bytes_, column_bytes_);
  const MeasurementBlock block = readBlock(column.data(), block_index, 0);
  if (!block.valid) return;
  points_.append({column.data() + channels_in_column_, angles_.cosine[block.measurement_id],
                  angles_.sine[block.measurement_id], t, block.measurement_id, sensor_id},
                 points);
}

std::vector<ImuSample> OusterDecoder::imuSamples(Bytes packet) const
{
  switch (layout_.imu_profile)
  {
    case OusterImuProfile::Legacy:
      return readLegacyImu(packet);
    case OusterImuProfile::Accel32Gyro32Nmea:
      return readAccelGyro(packet, layout_);
    case OusterImuProfile::Off:
      break;
  }
  return {};
}
}  // namespace scanloom
