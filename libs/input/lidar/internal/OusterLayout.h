/** Sizes and offsets of a sensor's packets, computed from its metadata. */
#pragma once
#include "base/core/Bytes.h"
#include "input/lidar/OusterProfiles.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace scanloom
{
enum class OusterHeader
{
  None,      // LEGACY: packets begin with the first column
  Standard,  // 32 bytes, frame ids of 16 bits, CRC-64 in the last 8 bytes of the packet
  Fusa,      // 32 bytes in another order, frame ids of 32 bits, no CRC
};

enum class OusterImuProfile
{
  Legacy,  // 48 bytes: one sample in g and deg/s
  Accel32Gyro32Nmea,
  Off,
};

struct ByteField
{
  std::size_t offset = 0;
  std::size_t count = 0;  // bytes; 0: no such field
};

/** Places of the fields in a packet's header. */
struct OusterHeaderFields
{
  std::size_t bytes;
  ByteField type, frame_id, init_id, serial, alert_flags, thermal_status, shot_limiting_status;
  std::uint64_t frame_id_modulus;
};
constexpr std::array<OusterHeaderFields, 3> kOusterHeaders = {{
    {0, {}, {10, 2}, {}, {}, {}, {}, {}, 0x10000},  // None: frame id of the first column
    {32, {0, 2}, {2, 2}, {4, 3}, {7, 5}, {12, 1}, {18, 1}, {19, 1}, 0x10000},
    {32, {0, 1}, {4, 4}, {1, 3}, {11, 5}, {8, 1}, {18, 1}, {19, 1}, 0x100000000},
}};
constexpr const OusterHeaderFields& headerFields(OusterHeader header)
{
  return kOusterHeaders[static_cast<std::size_t>(header)];
}

constexpr std::uint64_t kOusterLidarType = 1;
constexpr std::uint64_t kOusterImuType = 2;
constexpr std::uint64_t kOusterZoneType = 3;
constexpr std::size_t kOusterZonePacketBytes = 680;
constexpr std::uint8_t kOusterStatusMask = 0x0F;  // thermal and shot limiting states: the lower four bits

/** Column: stamp u64 @0, measurement id u16 @8, then frame id u16 @10 (LEGACY) or status u16 @10. */
constexpr std::size_t kOusterColumnStamp = 0;
constexpr std::size_t kOusterColumnMeasurementId = 8;
constexpr std::size_t kOusterColumnFrameIdOrStatus = 10;
constexpr std::size_t kOusterColumnEncoder = 12;  // LEGACY only: ticks of a turn
constexpr std::uint32_t kOusterEncoderTicks = 90112;
constexpr std::size_t kOusterCrcBytes = 8;

/** CRC-64/XZ: ECMA-182 polynomial, reflected (0xC96C5795D7870F42), initial value and final xor all ones. */
std::uint64_t crc64(Bytes);

/** Stamps from here on are invalid: differences of valid ones always fit into 64 bits. */
constexpr std::uint64_t kOusterEndOfTime = std::uint64_t{1} << 62;  // ns, 146 years

/** Units of LEGACY IMU packets. */
constexpr double kOusterStandardGravity = 9.80665;  // m/s2 per g
constexpr double kOusterDegree = 3.14159265358979323846 / 180;

/** LEGACY IMU packet: stamps u64, accelerations f32 in g, rates f32 in deg/s. */
namespace ouster_legacy_imu
{
constexpr std::size_t kBytes = 48, kSystemStamp = 0, kAccelStamp = 8, kGyroStamp = 16, kAccel = 24, kGyro = 36;
}
/** ACCEL32_GYRO32_NMEA: header, block of the NMEA input, measurements in SI units, footer. */
namespace ouster_accel_gyro
{
constexpr std::size_t kNmeaBytes = 100, kMeasurementBytes = 36;
constexpr std::size_t kStamp = 0, kMeasurementId = 8, kStatus = 10, kAccel = 12, kGyro = 24;
}  // namespace ouster_accel_gyro

struct OusterLayout
{
  const OusterProfile* profile = nullptr;  // a row of kOusterProfiles
  OusterHeader lidar_header = OusterHeader::Standard;
  OusterImuProfile imu_profile = OusterImuProfile::Legacy;
  OusterHeader imu_header = OusterHeader::None;
  std::size_t channels = 0;
  std::size_t columns = 0;  // per packet
  std::size_t imu_measurements = 1;

  bool isLegacy() const { return lidar_header == OusterHeader::None; }
  std::size_t headerBytes() const { return headerFields(lidar_header).bytes; }
  std::size_t columnHeaderBytes() const { return isLegacy() ? 16 : 12; }
  std::size_t columnFooterBytes() const { return isLegacy() ? 4 : 0; }
  std::size_t footerBytes() const { return isLegacy() ? 0 : 32; }
  std::size_t channelsBytes() const { return channels * profile->channel_bytes; }
  std::size_t columnBytes() const { return columnHeaderBytes() + channelsBytes() + columnFooterBytes(); }
  std::size_t lidarPacketBytes() const { return headerBytes() + columns * columnBytes() + footerBytes(); }
  std::size_t imuPacketBytes() const;  // 0 if the sensor sends no IMU packets
  static constexpr bool hasCrc(OusterHeader h) { return h == OusterHeader::Standard; }

  /** Offset of column `index` in a packet. */
  std::size_t columnOffset(std::size_t index) const { return headerBytes() + index * columnBytes(); }
};
}  // namespace scanloom
