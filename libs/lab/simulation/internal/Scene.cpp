#include "lab/simulation/internal/Scene.h"

#include "base/core/Angle.h"
#include "lab/simulation/internal/LidarStations.h"

namespace scanloom
{
namespace
{
constexpr Timestamp kStart{1'750'000'000s};
constexpr Duration kImuPhase = 1230us;  // no clock starts with the recording
}  // namespace

Scene makeScene(const SimulationSettings& settings, std::uint64_t seed)
{
  const std::uint64_t stand_seed =
      settings.forest.stand.seed > 0 ? static_cast<std::uint64_t>(settings.forest.stand.seed) : seed;
  const Timestamp start = kStart + 24h * settings.drive.day;
  const RecordingSpan span{start, settings.drive.duration};
  const Ground ground(settings.ground, settings.slopes);
  const Route route(settings.drive, settings.work, seed);
  BodyMotionOptions body = settings.body;
  body.upright = settings.machine.kind == "person";
  const Drive drive(route, settings.drive, body, ground, EngineVibration(settings.engine, VibratingPart::Body, seed));
  const Machine machine(partsOf(settings.machine), Boom(route, seed));
  std::vector<LidarStation> lidars = makeLidarStations(settings, span, seed);
  const Rigid body_T_imu = Rigid::fromXyzYawPitchRoll(0.1, -0.3, 2.8, 90 * kDegree, 1.2 * kDegree, -0.8 * kDegree);

  return {seed,
          span,
          Scenery(std::make_shared<const World>(ground, settings.forest, drive.path(), stand_seed,
                                                build(settings.buildings, drive, stand_seed)),
                  drive, machine, MovingObjects(settings.objects, drive, seed)),
          std::move(lidars),
          {body_T_imu,
           start + kImuPhase,
           settings.imu,
           {},
           RandomStream::BodyImu,
           0,
           EngineVibration(settings.engine, VibratingPart::ImuMount, seed)},
          TotalStation(settings.station, settings.body_T_prism.translation, span, seed),
          settings.gnss,
          settings.body_T_prism};
}
}  // namespace scanloom
