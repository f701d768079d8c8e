#include "site/internal/referencePositions.h"

#include <algorithm>
#include <optional>

namespace scanloom
{
namespace
{
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
  std::optional<StampedPosition> last;
  for (const StampedPosition& measured : reference.track)
  {
    const std::optional<std::size_t> before = keyframeBefore(measured.stamp, drive.keyframes());
    const std::optional<Rigid> drive_T_body = poseAt(drive.trajectory(), measured.stamp, kWidestGap);
    if (!before || !drive_T_body) continue;
    const bool errs_alike = last && ((last->position - drive_T_body->translation).norm() < reference.noise.apart ||
                                     measured.stamp - last->stamp < reference.noise.lasting);
    if (errs_alike) continue;
    last = StampedPosition{measured.stamp, drive_T_body->translation};
    positions.push_back({measured.stamp, first + *before,
                         drive.keyframes()[*before].drive_T_body.inverse() * (*drive_T_body * reference.body_p_point),
                         measured.position, reference.noise.sigma});
  }
  return positions;
}
}  // namespace

std::vector<ReferencePosition> referencePositions(const Reference& reference, const std::vector<SiteDrive>& drives,
                                                  const SiteLayout& layout)
{
  std::vector<ReferencePosition> all;
  for (std::size_t d = 0; d < drives.size(); ++d)
    for (ReferencePosition& position : ofDrive(reference, drives[d], layout.firstOf(d)))
      all.push_back(std::move(position));
  return all;
}
}  // namespace scanloom
