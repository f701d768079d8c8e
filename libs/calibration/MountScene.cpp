#include "calibration/MountScene.h"

#include "calibration/internal/someOf.h"

namespace scanloom
{
namespace
{
void append(std::vector<Eigen::Vector3f>& points, const View& view)
{
  points.insert(points.end(), view.points.begin(), view.points.end());
}

MountScene sceneOf(const Station& station, const Mount& before, const Mount& after, const Trajectory& trajectory)
{
  MountScene scene;
  for (const View& view : station.reference) append(scene.reference, view);
  for (const LidarScan* scan : station.scans)
  {
    const std::optional<View> then = viewFrom(*scan, before, trajectory, station.at);
    const std::optional<View> now = viewFrom(*scan, after, trajectory, station.at);
    if (!then || !now) continue;
    append(scene.before, *then);
    append(scene.after, *now);
  }
  return scene;
}
}  // namespace

std::vector<MountScene> mountScenes(const std::vector<Station>& stations, const Mount& before, const Mount& after,
                                    const Trajectory& trajectory)
{
  constexpr std::size_t kMost = 6;
  std::vector<MountScene> scenes;
  for (const Station& station : someOf(stations, kMost)) scenes.push_back(sceneOf(station, before, after, trajectory));
  return scenes;
}
}  // namespace scanloom
