#include "base/config/internal/RemovedKeys.h"

#include "base/config/Names.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace scanloom
{
namespace
{
constexpr std::string_view kSections[] = {
    "doctor",        "lidar_imu_noise",    "no_imu_noise",      "rough_registration",  "fine_registration",
    "smoother",      "register_alignment", "simulated_machine", "simulated_boom",      "simulated_objects",
    "simulated_rig", "simulated_network",  "simulated_imu",     "simulated_lidar_imu",
};

struct Keys
{
  std::string_view section, keys;  // separated and surrounded by blanks
};
constexpr Keys kKeys[] = {
    {"lidars", " imu_label max_queue_len scans_waiting max_clock_skew queue_packets "},
    {"slam", " imu_wait_ms refine correlation gate contradiction restart_after lost_after "},
    {"start", " max_slow_accel max_slow_gyro_deg max_mean_gyro_deg max_gravity_error "},
    {"imu_noise", " accel_bias_sigma "},
    {"scan_cells", " min_points min_deviation max_cells "},
    {"fine_cells", " min_points min_deviation max_cells "},
    {"map_cells", " min_points min_deviation max_cells "},
    {"keyframe_cells", " min_points min_deviation max_cells "},
    {"local_map", " keyframe_turn_deg "},
    {"simulated_work", " step_min step_max speed_min speed_max return_speed "},
    {"simulated_body", " work_sway vibration vibration_deg vibration_slow vibration_fast wheelbase track "},
    {"simulated_engine", " frequency harmonics decay broadband highest_frequency sideways turn_rate_deg "},
    {"simulated_precipitation", " drop_reflectivity flake_reflectivity flake_density aperture "},
    {"simulated_stand", " cluster_size free_lane reach stump_height "},
    {"simulated_trees", " dead_branch_base pine_branch_deg spruce_branch_deg birch_branch_deg branch_spread_deg "},
    {"simulated_foliage", " voxel leaf_area_density projection gaps undergrowth_patch undergrowth_lane "},
    {"simulated_wind", " direction_deg gust_length tip_sway sway_rate leaf_sway leaf_rate "},
    {"simulated_lidars", " rate_error_ppm first_frame_id burst_length restart_takes "},
    {"simulated_ranging",
     " range_noise range_noise_weak least_range beam_divergence_deg least_separation shade photons daylight sky ground "
     "stem branch crown undergrowth machine object "},
    {"simulated_total_station", " rate noise angle_noise x y height "},
};

constexpr std::string_view kIsConstant = "is a constant now, no key: leave it out";
constexpr std::string_view kOctomap =
    "was removed: `scanloom map -i keyframes.simplemap -o map.bt` writes the occupancy map, by --preset";
}  // namespace

std::string_view adviceOnRemoved(std::string_view section, std::string_view key)
{
  const bool is_gone = std::any_of(std::begin(kKeys), std::end(kKeys),
                                   [&](const Keys& gone) {
                                     return sameName(section, gone.section) &&
                                            gone.keys.find(fmt::format(" {} ", key)) != std::string_view::npos;
                                   });
  return is_gone ? kIsConstant : "";
}

std::string_view adviceOnRemoved(std::string_view section)
{
  if (sameName(section, "octomap")) return kOctomap;
  const bool is_gone = std::any_of(std::begin(kSections), std::end(kSections),
                                   [&](std::string_view gone) { return sameName(section, gone); });
  return is_gone ? kIsConstant : "";
}
}  // namespace scanloom
