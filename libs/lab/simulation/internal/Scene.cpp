#include "lab/simulation/internal/Scene.h"

#include "input/rig/Extrinsics.h"
#include "lab/simulation/internal/LidarStations.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr Timestamp kStart{1'750'000'000s};
constexpr Duration kImuPhase = 1230us;  // no clock starts with the recording

Rigid rigPose(const char* name, const std::string& text)
{
  try
  {
    return parsePose(text);
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(fmt::format("[simulated_rig] {}: {}", name, error.what()));
  }
}
}  // namespace

Scene makeScene(const SimulationSettings& settings, std::uint64_t seed)
{
  const RecordingSpan span{kStart, settings.drive.duration};
  const Ground ground(settings.ground, settings.slopes);
  const Route route(settings.drive, settings.work, seed);
  const Drive drive(route, settings.drive, settings.body, ground,
                    EngineVibration(settings.engine, VibratingPart::Body, seed));
  const Machine machine(settings.machine, Boom(settings.boom, route, seed));
  std::vector<LidarStation> lidars = makeLidarStations(settings, span, seed);
  const Rigid body_T_imu = rigPose("imu_pose", settings.rig.imu_pose);
  const Rigid body_T_prism = rigPose("prism_pose", settings.rig.prism_pose);

  return {seed,
          span,
          Scenery(std::make_shared<const World>(ground, settings.forest, drive.path(), seed), drive, machine,
                  MovingObjects(settings.objects, drive, seed)),
          std::move(lidars),
          settings.network,
          {body_T_imu,
           kStart + kImuPhase,
           settings.imu,
           {},
           RandomStream::BodyImu,
           0,
           EngineVibration(settings.engine, VibratingPart::ImuMount, seed)},
          TotalStation(settings.station, body_T_prism.translation, span, seed),
          body_T_prism};
}
}  // namespace scanloom
