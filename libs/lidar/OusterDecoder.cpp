#include "lidar/OusterDecoder.h"

#include <cmath>

#include "lidar/Crc64.h"
#include "lidar/OusterImu.h"

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

bool crcHolds(Bytes packet)
{
  const std::size_t end = packet.size() - kOusterCrcBytes;
  const auto stored = load<std::uint64_t>(packet, end);
  return stored == kNoCrcFirmware22 || stored == kNoCrcFirmware23 || stored == crc64(packet.slice(0, end));
}
}  // namespace

Rigid rigidFromMillimetres(Eigen::Matrix4d matrix)
{
  matrix.col(3).head<3>() *= 1e-3;
  return Rigid::fromMatrix(matrix);
}

std::vector<Beam> beamsOf(const OusterMetadata& m)
{
  constexpr double kDegree = M_PI / 180;
  const double x = 1e-3 * m.beam_to_lidar_mm(0, 3), z = 1e-3 * m.beam_to_lidar_mm(2, 3);
  std::vector<Beam> beams;
  for (std::size_t i = 0; i < m.beam_altitude_deg.size(); ++i)
    beams.push_back(
        Beam{-m.beam_azimuth_deg[i] * kDegree, m.beam_altitude_deg[i] * kDegree, {x, 0, z}, std::hypot(x, z)});
  return beams;
}

// By value and checked again: metadata may have been put together by hand.
OusterDecoder::OusterDecoder(OusterMetadata metadata, const Rigid& body_T_sensor)
  : metadata_(parseOusterMetadata(toJson(metadata), "OusterDecoder")),
    layout_(layoutOf(metadata_)),
    description_(describe(metadata_, body_T_sensor)),
    serial_(serialNumber(metadata_)),
    beams_(beamsOf(metadata_), body_T_sensor * rigidFromMillimetres(metadata_.lidar_to_sensor_mm)),
    angles_(clockwiseColumns(metadata_.columns_per_frame)),
    append_(appenderFor(*layout_.profile))
{
}

bool OusterDecoder::isForeign(Bytes packet) const
{
  const OusterHeaderFields& fields = headerFields(metadata_.header_type);
  if (!serial_ || packet.size() < fields.bytes) return false;
  const std::uint64_t type = loadField(packet, fields.type), serial = loadField(packet, fields.serial);
  return type >= kOusterLidarType && type <= kOusterZoneType && serial != 0 && serial != *serial_;
}

PacketKind OusterDecoder::kindIfIntact(Bytes packet, OusterHeader header, PacketKind kind) const
{
  if (header == OusterHeader::None) return kind;
  if (OusterLayout::hasCrc(header) && !crcHolds(packet)) return PacketKind::BadCrc;
  return isForeign(packet) ? PacketKind::Foreign : kind;
}

PacketKind OusterDecoder::kind(Bytes packet) const
{
  const auto isOfType = [&](OusterHeader header, std::uint64_t type)
  {
    const OusterHeaderFields& fields = headerFields(header);
    return header == OusterHeader::None || loadField(packet, fields.type) == type;
  };
  if (packet.size() == layout_.lidarPacketBytes() && isOfType(layout_.lidar_header, kOusterLidarType))
    return kindIfIntact(packet, layout_.lidar_header, PacketKind::Lidar);
  if (!packet.empty() && packet.size() == layout_.imuPacketBytes() && isOfType(layout_.imu_header, kOusterImuType))
    return kindIfIntact(packet, layout_.imu_header, PacketKind::Imu);
  if (packet.size() == kOusterZonePacketBytes && isOfType(metadata_.header_type, kOusterZoneType))
    return kindIfIntact(packet, metadata_.header_type, PacketKind::Other);
  // Of a size that this sensor never sends: a neighbour's on the same port, or damage.
  return !layout_.isLegacy() && isForeign(packet) ? PacketKind::Foreign : PacketKind::Malformed;
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

std::uint32_t OusterDecoder::columnStatus(Bytes packet, std::size_t index) const
{
  const Bytes column = packet.slice(layout_.columnOffset(index), layout_.columnBytes());
  if (layout_.isLegacy()) return load<std::uint32_t>(column, column.size() - layout_.columnFooterBytes());
  return load<std::uint16_t>(column, kOusterColumnFrameIdOrStatus);
}

MeasurementBlock OusterDecoder::readBlock(Bytes packet, std::size_t index, std::uint32_t packet_frame_id) const
{
  const Bytes column = packet.slice(layout_.columnOffset(index), layout_.columnHeaderBytes());
  const auto stamp = load<std::uint64_t>(column, kOusterColumnStamp);
  MeasurementBlock block;
  block.stamp = fromNanoseconds(static_cast<std::int64_t>(stamp));
  block.measurement_id = load<std::uint16_t>(column, kOusterColumnMeasurementId);
  block.frame_id = layout_.isLegacy() ? load<std::uint16_t>(column, kOusterColumnFrameIdOrStatus) : packet_frame_id;
  block.index = static_cast<std::uint16_t>(index);
  block.valid = (columnStatus(packet, index) & 1) != 0 && block.measurement_id < metadata_.columns_per_frame &&
                stamp < kOusterEndOfTime;
  return block;
}

void OusterDecoder::readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const
{
  const auto frame_id = static_cast<std::uint32_t>(loadField(packet, headerFields(layout_.lidar_header).frame_id));
  blocks.clear();
  for (std::size_t i = 0; i < layout_.columns; ++i) blocks.push_back(readBlock(packet, i, frame_id));
}

void OusterDecoder::appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                                 PointCloud& points) const
{
  if (block_index >= layout_.columns) throw std::out_of_range("appendPoints: the packet has no such block");
  const MeasurementBlock block = readBlock(packet, block_index, 0);
  if (!block.valid) return;
  const std::size_t channels = layout_.columnOffset(block_index) + layout_.columnHeaderBytes();
  append_({packet.slice(channels, layout_.channelsBytes()), angles_.cosine[block.measurement_id],
           angles_.sine[block.measurement_id], t, block.measurement_id, sensor_id},
          beams_, points);
}

std::vector<ImuSample> OusterDecoder::imuSamples(Bytes packet) const { return readOusterImu(packet, layout_); }
}  // namespace scanloom
