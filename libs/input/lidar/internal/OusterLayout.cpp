#include "input/lidar/internal/OusterLayout.h"

#include "input/lidar/OusterMetadata.h"

#include <fmt/format.h>
#include <lzma.h>

#include <algorithm>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr bool allConsistent()
{
  for (const OusterProfile& p : kOusterProfiles)
    if (!isConsistent(p)) return false;
  return true;
}
static_assert(allConsistent(), "a field of kOusterProfiles does not fit into its channel or its type");
}  // namespace

std::uint64_t crc64(Bytes bytes) { return lzma_crc64(bytes.data(), bytes.size(), 0); }

std::size_t OusterLayout::imuPacketBytes() const
{
  switch (imu_profile)
  {
    case OusterImuProfile::Legacy:
      return ouster_legacy_imu::kBytes;
    case OusterImuProfile::Off:
      return 0;
    case OusterImuProfile::Accel32Gyro32Nmea:
      break;
  }
  return headerFields(imu_header).bytes + ouster_accel_gyro::kNmeaBytes +
         imu_measurements * ouster_accel_gyro::kMeasurementBytes + 32;
}

const OusterProfile* findOusterProfile(std::string_view name)
{
  const auto row = std::find_if(kOusterProfiles.begin(), kOusterProfiles.end(),
                                [&](const OusterProfile& p) { return p.name == name; });
  return row == kOusterProfiles.end() ? nullptr : &*row;
}

OusterLayout layoutOf(const OusterMetadata& m)
{
  OusterLayout layout;
  layout.profile = findOusterProfile(m.lidar_profile);
  if (!layout.profile) throw std::invalid_argument(fmt::format("lidar_profile '{}' is unknown", m.lidar_profile));
  layout.lidar_header = m.lidar_profile == "LEGACY" ? OusterHeader::None : m.header_type;
  layout.imu_profile = m.imu_profile;
  layout.imu_header = m.imu_profile == OusterImuProfile::Legacy ? OusterHeader::None : m.header_type;
  layout.channels = static_cast<std::size_t>(m.channels);
  layout.columns = static_cast<std::size_t>(m.columns_per_packet);
  layout.imu_measurements = static_cast<std::size_t>(m.imu_measurements_per_packet);
  return layout;
}

std::optional<std::uint64_t> serialNumber(const OusterMetadata& m)
{
  const bool digits = !m.serial.empty() && m.serial.size() <= 13 &&
                      std::all_of(m.serial.begin(), m.serial.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits) return std::nullopt;
  const std::uint64_t number = std::stoull(m.serial);
  if (number == 0 || number >= (std::uint64_t{1} << 40)) return std::nullopt;
  return number;
}
}  // namespace scanloom
