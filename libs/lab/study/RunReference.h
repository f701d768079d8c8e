/** What the trajectory of a run is compared with: a total station, poses, or nothing. */
#pragma once
#include "base/positions/PositionTrack.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>

namespace scanloom
{
/** In place of a file: the run is not compared. */
inline constexpr const char* kNoReference = "none";

/** A run without station and poses is not compared. */
struct RunReference
{
  std::optional<PositionTrack> station;
  std::optional<Trajectory> poses;                         // of the body
  Eigen::Vector3d body_p_point = Eigen::Vector3d::Zero();  // m: the prism, if the station is compared
  std::string description;                                 // "total_station.csv at the prism"; empty: none

  bool exists() const { return station || poses; }
};

/**
 * @param recording file or folder. Of the files in its folder, `total_station` (.csv, .tsv) and `groundtruth` (TUM,
 * EuRoC, KITTI) are taken, with T_body_prism of the extrinsics there; without it the body's origin is compared.
 * @param given a file that is taken instead of both, or kNoReference; empty: none.
 * Throws what reading them throws.
 */
RunReference referenceOf(const std::filesystem::path& recording, const std::filesystem::path& given);
}  // namespace scanloom
