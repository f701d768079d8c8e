/** The metadata file of an Ouster sensor: old (flat) or new (nested) layout, firmware 1.12 to 3.x. */
#pragma once
#include "input/lidar/internal/OusterLayout.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** The contents of the file, hence more than a dozen members. */
struct OusterMetadata
{
  std::string product_line;  // "OS-0-128"; empty if the file does not say
  std::string serial;        // empty if the file does not say
  std::string firmware;      // build_rev, "v2.3.0"; empty if the file does not say
  std::optional<std::uint32_t> init_id;
  std::string lidar_mode;      // "1024x10"
  std::string timestamp_mode;  // "TIME_FROM_PTP_1588"; empty if the file does not say

  std::string lidar_profile = "LEGACY";  // a name of kOusterProfiles
  OusterImuProfile imu_profile = OusterImuProfile::Legacy;
  OusterHeader header_type = OusterHeader::Standard;  // of packets that have a header
  int channels = 0;
  int columns_per_packet = 16;
  int columns_per_frame = 0;
  int first_column = 0, last_column = 0;  // inclusive; wraps around 0 if first > last
  double frame_rate = 0;                  // Hz
  int imu_measurements_per_packet = 0;
  int imu_packets_per_frame = 0;
  std::uint16_t lidar_port = 0, imu_port = 0;  // 0 if the file does not say

  std::vector<double> beam_altitude_deg, beam_azimuth_deg;         // one per channel; azimuths are clockwise
  Eigen::Matrix4d beam_to_lidar_mm = Eigen::Matrix4d::Identity();  // translations in mm, as in the file
  Eigen::Matrix4d lidar_to_sensor_mm = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d imu_to_sensor_mm = Eigen::Matrix4d::Identity();
};

/** Where a sensor sends unless it is configured otherwise. */
constexpr std::uint16_t kOusterLidarPort = 7502, kOusterImuPort = 7503;

/** Whether this is the text of such a file, complete or not: a JSON object that names one of its keys. */
bool looksLikeOuster(const std::string& text);

/**
 * Reads either layout. Required: lidar_mode, beam_altitude_angles, beam_azimuth_angles. Defaults for the rest are those
 * of the maker's SDK: profile LEGACY, 16 columns per packet, a full window, one channel per beam angle, the transforms
 * of the product line (without one: of the first generation). Extrinsics in "ouster-sdk" are not read: poses on the
 * machine come from the configuration alone.
 *
 * Throws std::invalid_argument with `name`, the key and what is expected: not JSON, a required key missing, a wrong
 * type or length, a value out of range, an unknown profile, a solid-state sensor.
 */
OusterMetadata parseOusterMetadata(const std::string& text, const std::string& name);

/** The same from a file. Also throws std::invalid_argument if it cannot be read. */
OusterMetadata loadOusterMetadata(const std::string& path);

/** JSON in the nested layout. parseOusterMetadata() returns the same values from it. */
std::string toJson(const OusterMetadata&);

OusterLayout layoutOf(const OusterMetadata&);

/** The serial number as in packets; nothing if there is none or it does not fit into 40 bits. */
std::optional<std::uint64_t> serialNumber(const OusterMetadata&);
}  // namespace scanloom
