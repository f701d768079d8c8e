#include "run/run/Calibration.h"

#include "calibration/ExtrinsicsReport.h"
#include "calibration/FieldOfViewOverlap.h"
#include "calibration/ImuExtrinsicsReport.h"
#include "input/rig/Extrinsics.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
/**
 * Whether both lidars see something in much the same directions. If not, each sees sides of stems that the other does
 * not, and stems must be compared by their axes.
 */
bool lookAlike(const std::vector<LidarScan>& of_lidar, const std::vector<LidarScan>& of_reference,
               const Extrinsics& reference, const Trajectory& trajectory, const Extrinsics& extrinsics)
{
  constexpr Surroundings kAtOnce{0};
  constexpr double kLeast = 0.4;  // 0.50 to 0.57 for lidars that see all around, 0.23 to 0.33 for half turns apart
  const std::vector<Station> stations = stationsOf(of_lidar, of_reference, reference, trajectory, kAtOnce);
  return commonField(stations, extrinsics, trajectory) > kLeast;
}

/** Beside the machine it saw nothing in most scans, so that its few places do not mean that the machine stood still. */
bool isCovered(const std::vector<LidarScan>& of_lidar, const std::vector<LidarScan>& of_reference)
{
  return 2 * of_lidar.size() < of_reference.size();
}

/** More of the drive, from farther away, does not tell a clock better. */
bool tellsPose(const ExtrinsicsEstimate& estimate)
{
  const auto isClock = [](const OpenDirection& open) { return open.isClock(); };
  return trusted(estimate) || (estimate.outcome == ExtrinsicsOutcome::Open &&
                               std::all_of(estimate.open.begin(), estimate.open.end(), isClock));
}
}  // namespace

LidarCalibration calibrateLidar(std::size_t lidar, const std::vector<MountedLidar>& lidars, std::size_t reference,
                                const CalibrationDrive& drive, Clock clock, PoseGiven known)
{
  constexpr Surroundings kNear{5, Stems::AsSeen}, kFar{7, Stems::OnAxes};
  const std::vector<LidarScan>&own = drive.scans[lidar], &others = drive.scans[reference];
  const Extrinsics of_reference{lidars[reference].body_T_sensor, 0}, given{lidars[lidar].body_T_sensor, 0};
  LidarCalibration calibration;
  calibration.estimate.extrinsics = given;
  calibration.estimate.outcome = ExtrinsicsOutcome::NothingShared;
  if (isCovered(own, others)) return calibration;
  const RotationByImus imus =
      rotationByImus(drive.lidar_imus[lidar], drive.lidar_imus[reference], of_reference.body_T_sensor);
  std::optional<Extrinsics> near;  // by the scans from near around, stems as seen
  for (const Surroundings& around : {kNear, kFar})
  {
    const std::vector<Station> stations = stationsOf(own, others, of_reference, drive.trajectory, around);
    if (stations.empty()) return calibration;
    const ExtrinsicsStart start = findStart(stations, known == PoseGiven::No ? std::nullopt : std::optional(given), own,
                                            others, of_reference.body_T_sensor, drive.trajectory, imus);
    ExtrinsicsEstimate estimate = estimateExtrinsics(stations, given, start, drive.trajectory, clock, imus);
    if (estimate.outcome == ExtrinsicsOutcome::StoodStill) return {estimate, {}};
    if (near && tellsPose(estimate)) estimate = doubted(std::move(estimate), *near, given);
    calibration = {estimate, extrinsicsScenes(stations, given, estimate.extrinsics, drive.trajectory)};
    if (!tellsPose(estimate)) continue;
    if (near || lookAlike(own, others, of_reference, drive.trajectory, estimate.extrinsics)) break;
    near = estimate.extrinsics;
  }
  return calibration;
}

bool trusted(const Calibration& calibration)
{
  bool all = !calibration.imu || trusted(*calibration.imu);
  for (std::size_t i = 0; i < calibration.lidars.size(); ++i)
    all = all && (i == calibration.reference || trusted(calibration.extrinsics[i]));
  return all;
}

std::string extrinsicsText(const Calibration& calibration)
{
  std::string text = "# T_a_b maps coordinates in b to a: x y z yaw pitch roll (m, deg)\n";
  const auto add = [&](const std::string& sensor, const Rigid& pose, const char* comment)
  { text += fmt::format("T_body_{} {}  # {}\n", sensor, poseText(pose), comment); };
  for (std::size_t i = 0; i < calibration.lidars.size(); ++i)
  {
    const MountedLidar& lidar = calibration.lidars[i];
    if (i == calibration.reference)
      add(lidar.name, lidar.body_T_sensor, "as given");
    else
      add(lidar.name, calibration.extrinsics[i].extrinsics.body_T_sensor,
          trusted(calibration.extrinsics[i]) ? "calibrated" : "not calibrated");
  }
  if (calibration.imu)
    add("imu", calibration.imu->extrinsics.body_T_sensor, trusted(*calibration.imu) ? "calibrated" : "not calibrated");
  return text;
}

nlohmann::json toJson(const Calibration& calibration)
{
  nlohmann::json json{{"reference", calibration.lidars[calibration.reference].name},
                      {"lidars", nlohmann::json::array()}};
  for (std::size_t i = 0; i < calibration.lidars.size(); ++i)
    if (i != calibration.reference)
      json["lidars"].push_back(toJson(calibration.lidars[i].name, calibration.extrinsics[i]));
  if (calibration.imu) json["imu"] = toJson(*calibration.imu);
  return json;
}
}  // namespace scanloom
