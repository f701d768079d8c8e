#include "calibration/internal/Stations.h"

#include "base/core/Angle.h"
#include "calibration/internal/someOf.h"

#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kStationStep = 0.7, kViewStep = 1;  // m
constexpr double kTurn = 10 * kDegree;
constexpr std::size_t kMostStations = 60;

struct Placed
{
  const LidarScan* scan;
  Rigid map_T_body;
};

bool apart(const Rigid& a, const Rigid& b, double step)
{
  return (a.translation - b.translation).norm() >= step || a.rotation.angularDistance(b.rotation) >= kTurn;
}

std::vector<Placed> placesOf(const std::vector<LidarScan>& scans, const Trajectory& trajectory, double step)
{
  std::vector<Placed> places;
  for (const LidarScan& scan : scans)
  {
    const std::optional<Rigid> pose = poseAt(trajectory, scan.middle());
    const bool covered = pose && poseAt(trajectory, scan.start) && poseAt(trajectory, scan.start + scan.period);
    if (covered && (places.empty() || apart(places.back().map_T_body, *pose, step))) places.push_back({&scan, *pose});
  }
  return places;
}

Vector6d twistAt(const Trajectory& trajectory, Timestamp at)
{
  constexpr Duration kSide = 50ms;
  const std::optional<Rigid> before = poseAt(trajectory, at - kSide), after = poseAt(trajectory, at + kSide);
  if (!before || !after) return Vector6d::Zero();
  return boxMinus(*after, *before) / seconds(2 * kSide);
}

/** The scan at the same time comes first: a machine that works on the spot turns and sways. */
std::vector<const LidarScan*> scansAround(const Placed& here, const std::vector<LidarScan>& all,
                                          const std::vector<Placed>& places, double reach)
{
  std::vector<const LidarScan*> scans;
  for (const LidarScan& scan : all)
    if (scan.start == here.scan->start) scans.push_back(&scan);
  for (const Placed& place : places)
    if (place.scan->start != here.scan->start &&
        (place.map_T_body.translation - here.map_T_body.translation).norm() < reach)
      scans.push_back(place.scan);
  return scans;
}

std::vector<View> viewsOf(const std::vector<const LidarScan*>& scans, const Extrinsics& extrinsics,
                          const Trajectory& trajectory, Timestamp at, Stems stems)
{
  std::vector<View> views;
  for (const LidarScan* scan : scans)
    if (std::optional<View> view = viewFrom(*scan, extrinsics, trajectory, at, stems))
      views.push_back(std::move(*view));
  return views;
}
}  // namespace

std::vector<const LidarScan*> scansApart(const std::vector<LidarScan>& scans, const Trajectory& trajectory)
{
  std::vector<const LidarScan*> apart;
  for (const Placed& place : placesOf(scans, trajectory, kViewStep)) apart.push_back(place.scan);
  return apart;
}

std::vector<Station> stationsOf(const std::vector<LidarScan>& of_lidar, const std::vector<LidarScan>& of_reference,
                                const Extrinsics& reference, const Trajectory& trajectory, const Surroundings& around)
{
  const std::vector<Placed> all = placesOf(of_lidar, trajectory, kStationStep);
  const std::vector<Placed> own = placesOf(of_lidar, trajectory, kViewStep);
  const std::vector<Placed> others = placesOf(of_reference, trajectory, kViewStep);
  std::vector<Station> stations;
  for (const Placed& here : someOf(all, kMostStations))
  {
    const Timestamp at = here.scan->middle();
    const std::vector<const LidarScan*> of_others = scansAround(here, of_reference, others, around.reach);
    stations.push_back({at, scansAround(here, of_lidar, own, around.reach),
                        viewsOf(of_others, reference, trajectory, at, around.stems), twistAt(trajectory, at),
                        around.stems});
  }
  return stations;
}
}  // namespace scanloom
