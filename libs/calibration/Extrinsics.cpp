#include "calibration/Extrinsics.h"

#include "estimation/ndt/ForestCorrections.h"

namespace scanloom
{
namespace
{
constexpr Duration kWidestGap = 500ms;
}

std::optional<View> viewFrom(const LidarScan& scan, const Extrinsics& extrinsics, const Trajectory& trajectory,
                             Timestamp at, Stems stems)
{
  const std::optional<Rigid> map_T_body = poseAt(trajectory, at, kWidestGap);
  if (!map_T_body) return std::nullopt;
  const Rigid body_T_map = map_T_body->inverse();
  const auto sensorAt = [&](Timestamp stamp) -> std::optional<Rigid>
  {
    const std::optional<Rigid> then = poseAt(trajectory, stamp - fromSeconds(extrinsics.clock_offset), kWidestGap);
    if (!then) return std::nullopt;
    return body_T_map * *then * extrinsics.body_T_sensor;
  };

  View view;
  view.points.reserve(scan.points.size());
  std::optional<std::int32_t> t;
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;
  for (std::size_t i = 0; i < scan.points.size(); ++i)
  {
    if (scan.t[i] != t)
    {
      const std::optional<Rigid> here_T_sensor = sensorAt(scan.start + Duration{scan.t[i]});
      if (!here_T_sensor) return std::nullopt;
      rotation = here_T_sensor->rotation.toRotationMatrix().cast<float>();
      translation = here_T_sensor->translation.cast<float>();
      t = scan.t[i];
    }
    view.points.emplace_back(rotation * scan.points[i] + translation);
  }
  const std::optional<Rigid> here_T_sensor = sensorAt(scan.middle());
  if (stems == Stems::OnAxes && here_T_sensor)
  {
    view.viewpoint = here_T_sensor->translation;
    view.corrections = forestCorrections();
  }
  return view;
}
}  // namespace scanloom
