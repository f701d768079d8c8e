#include "estimation/slam/internal/Relocalisation.h"

#include "estimation/imu/MeanForce.h"
#include "estimation/slam/internal/DeadReckoning.h"

#include <algorithm>

namespace scanloom
{
namespace
{
/**
 * Places that look alike are found with a wrong tilt, along which gravity would then accelerate the body. A working IMU
 * knows the tilt; where place and IMU differ, the accelerometer tells which of them is right.
 */
bool isTiltPossible(const Eigen::Quaterniond& local_R_body, const LostBody& lost, const Eigen::Vector3d& up_in_local)
{
  constexpr double kWorkingImu = 3;  // deg
  const auto lean = [&](const Eigen::Quaterniond& rotation) { return degreesBetween(rotation * lost.up, up_in_local); };
  const double apart =
      degreesBetween(local_R_body.conjugate() * up_in_local, lost.local_R_body.conjugate() * up_in_local);
  return apart < kWorkingImu || lean(local_R_body) < lean(lost.local_R_body);
}
}  // namespace

void Relocalisation::changeBias(const ImuBias& bias)
{
  if (last_seen_) last_seen_->bias = bias;
}

std::vector<Rigid> Relocalisation::nextStarts(const SearchArea& area)
{
  constexpr std::size_t kScreened = 30;  // scores, and steps from the best of them: as long as about two alignments
  const std::vector<Rigid> all = startsWithin(area);
  if (next_start_ >= all.size()) next_start_ = 0;
  const std::size_t end = std::min(all.size(), next_start_ + kScreened);
  const std::vector<Rigid> next(all.begin() + static_cast<std::ptrdiff_t>(next_start_),
                                all.begin() + static_cast<std::ptrdiff_t>(end));
  next_start_ = end;
  return next;
}

std::optional<FoundBody> Relocalisation::search(const NdtMap& local_map, const std::vector<View>& views,
                                                const LostBody& lost, const ScanRegistrationOptions& options,
                                                StageTimes& times)
{
  constexpr double kFarthest = 10;  // m
  constexpr double kAsGood = 0.75;  // of the last trusted registration's score
  if (!last_seen_) return std::nullopt;
  const SearchArea area{{lost.local_R_body, last_seen_->local_T_body.translation},
                        std::min(kFarthest, kMachineSpeed * seconds(lost.since_trusted))};
  const std::vector<Rigid> starts = nextStarts(area);
  const Eigen::Vector3d up = last_seen_->map_T_local.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  const auto isPossible = [&](const Rigid& local_T_body) { return isTiltPossible(local_T_body.rotation, lost, up); };
  const auto found =
      times.measure("relocalisation",
                    [&] { return relocalise(local_map, views, starts, isPossible, options.fine_cells, options.fine); });
  if (!found || found->score > kAsGood * last_seen_->score) return std::nullopt;  // scores are negative
  next_start_ = 0;
  return FoundBody{*found, covarianceWithin(area, *found)};
}
}  // namespace scanloom
