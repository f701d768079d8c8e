#include "estimation/slam/internal/Relocalisation.h"

#include "estimation/imu/MeanForce.h"
#include "estimation/ndt/FittedConstants.h"
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
  const auto lean = [&](const Eigen::Quaterniond& rotation) { return degreesBetween(rotation * lost.up, up_in_local); };
  const double apart =
      degreesBetween(local_R_body.conjugate() * up_in_local, lost.local_R_body.conjugate() * up_in_local);
  return apart < fitted::kWorkingImuDeg || lean(local_R_body) < lean(lost.local_R_body);
}

std::vector<Rigid> part(const std::vector<Rigid>& all, std::size_t begin, std::size_t end)
{
  return {all.begin() + static_cast<std::ptrdiff_t>(begin), all.begin() + static_cast<std::ptrdiff_t>(end)};
}
}  // namespace

void Relocalisation::changeBias(const ImuBias& bias)
{
  if (last_seen_) last_seen_->bias = bias;
}

Search Relocalisation::search(const NdtMap& local_map, const std::vector<View>& views, const LostBody& lost,
                              const ScanRegistrationOptions& options) const
{
  const std::size_t screened = 30;  // scores, and steps from the best of them: as long as about two alignments
  if (!last_seen_) return {{}, *this, {}};
  const SearchArea area{{lost.local_R_body, last_seen_->local_T_body.translation},
                        std::min(10.0, fitted::kMachineSpeed * seconds(lost.since_trusted))};
  const std::vector<Rigid> all = startsWithin(area);
  const std::size_t begin = next_start_ < all.size() ? next_start_ : 0, end = std::min(all.size(), begin + screened);
  const std::vector<Rigid> starts = part(all, begin, end);
  const Eigen::Vector3d up = last_seen_->map_T_local.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  const auto isPossible = [&](const Rigid& local_T_body) { return isTiltPossible(local_T_body.rotation, lost, up); };

  Search search{{}, *this, {}};
  const auto found = search.times.measure(
      "relocalisation",
      [&] { return relocalise(local_map, views, starts, isPossible, options.fine_cells, options.fine); });
  const bool is_found = found && !(found->score > fitted::kScoreOfPlace * last_seen_->score);  // scores are negative
  search.after.next_start_ = is_found ? 0 : end;
  if (is_found) search.found = FoundBody{*found, covarianceWithin(area, *found)};
  return search;
}
}  // namespace scanloom
