#include "calibration/ExtrinsicsScene.h"

#include "calibration/internal/someOf.h"

namespace scanloom
{
namespace
{
void append(std::vector<Eigen::Vector3f>& points, const View& view)
{
  points.insert(points.end(), view.points.begin(), view.points.end());
}

ExtrinsicsScene sceneOf(const Station& station, const Extrinsics& before, const Extrinsics& after,
                        const Trajectory& trajectory)
{
  ExtrinsicsScene scene;
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

std::vector<ExtrinsicsScene> extrinsicsScenes(const std::vector<Station>& stations, const Extrinsics& before,
                                              const Extrinsics& after, const Trajectory& trajectory)
{
  constexpr std::size_t kMost = 6;
  std::vector<ExtrinsicsScene> scenes;
  for (const Station& station : someOf(stations, kMost)) scenes.push_back(sceneOf(station, before, after, trajectory));
  return scenes;
}
}  // namespace scanloom
