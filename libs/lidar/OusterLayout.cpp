#include "lidar/OusterLayout.h"

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
static_assert(allConsistent(), "a field of kOusterProfiles leaves its channel or its type");

constexpr OusterHeaderFields kNone{0, {}, {10, 2}, {}, {}, {}, {}, {}, 0x10000};  // the frame id of the first column
constexpr OusterHeaderFields kStandard{32, {0, 2}, {2, 2}, {4, 3}, {7, 5}, {12, 1}, {18, 1}, {19, 1}, 0x10000};
constexpr OusterHeaderFields kFusa{32, {0, 1}, {4, 4}, {1, 3}, {11, 5}, {8, 1}, {18, 1}, {19, 1}, 0x100000000};
}  // namespace

const OusterHeaderFields& headerFields(OusterHeader header)
{
  switch (header)
  {
    case OusterHeader::None:
      return kNone;
    case OusterHeader::Standard:
      return kStandard;
    case OusterHeader::Fusa:
      break;
  }
  return kFusa;
}

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
}  // namespace scanloom
