#include "site/internal/referencePositions.h"

#include <algorithm>
#include <optional>

namespace scanloom
{
namespace
{
constexpr double kApart = 1;         // m: nearer positions err alike
constexpr Duration kWidestGap = 2s;  // between poses: in a wider one nothing tells where the body was

/** Of the last keyframe before the stamp; none before the first. */
std::optional<std::size_t> keyframeBefore(Timestamp stamp, const std::vector<DriveKeyframe>& keyframes)
{
  const auto after = std::upper_bound(keyframes.begin(), keyframes.end(), stamp,
                                      [](Timestamp t, const DriveKeyframe& keyframe) { return t < keyframe.stamp; });
  if (after == keyframes.begin()) return std::nullopt;
  return static_cast<std::size_t>(after - keyframes.begin() - 1);
}

std::vector<ReferencePosition> ofDrive(const Reference& reference, const SiteDrive& drive, std::size_t first)
{
  std::vector<ReferencePosition> positions;
  std::optional<Eigen::Vector3d> last;
  for (const StampedPosition& measured : reference.track)
  {
    const std::optional<std::size_t> before = keyframeBefore(measured.stamp, drive.keyframes());
    const std::optional<Rigid> drive_T_body = poseAt(drive.trajectory(), measured.stamp, kWidestGap);
    if (!before || !drive_T_body) continue;
    if (last && (*last - drive_T_body->translation).norm() < kApart) continue;
    last = drive_T_body->translation;
    positions.push_back({measured.stamp, first + *before,
                         drive.keyframes()[*before].drive_T_body.inverse() * (*drive_T_body * reference.body_p_point),
                         measured.position, measured.sigma > 0 ? measured.sigma : reference.noise.sigma,
                         measured.name});
  }
  return positions;
}

/** Those within the time for which errors last count as one. */
std::vector<ReferencePosition> shared(std::vector<ReferencePosition> positions, const ReferenceNoise& noise)
{
  std::size_t begin = 0, end = 0;
  for (ReferencePosition& position : positions)
  {
    while (position.stamp - positions[begin].stamp > noise.lasting / 2) ++begin;
    while (end < positions.size() && positions[end].stamp - position.stamp <= noise.lasting / 2) ++end;
    position.share = 1 / static_cast<double>(end - begin);
  }
  return positions;
}
}  // namespace

std::vector<ReferencePosition> referencePositions(const Reference& reference, const std::vector<SiteDrive>& drives,
                                                  const SiteLayout& layout)
{
  std::vector<ReferencePosition> all;
  for (std::size_t d = 0; d < drives.size(); ++d)
    for (ReferencePosition& position : shared(ofDrive(reference, drives[d], layout.firstOf(d)), reference.noise))
      all.push_back(std::move(position));
  return all;
}
}  // namespace scanloom
