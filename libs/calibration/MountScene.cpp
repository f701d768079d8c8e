#include "calibration/MountScene.h"

#include <algorithm>

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
  const std::size_t count = std::min(kMost, stations.size());
  std::vector<MountScene> scenes;
  for (std::size_t i = 0; i < count; ++i)
    scenes.push_back(sceneOf(stations[i * stations.size() / count], before, after, trajectory));
  return scenes;
}
}  // namespace scanloom
