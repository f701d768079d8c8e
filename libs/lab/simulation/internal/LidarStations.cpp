#include "lab/simulation/internal/LidarStations.h"

#include "base/core/fileNameOf.h"
#include "input/lidar/OusterDecoder.h"
#include "input/rig/Extrinsics.h"
#include "lab/simulation/internal/AssumedOuster.h"

#include <fmt/format.h>

#include <functional>
#include <set>
#include <sstream>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr Timestamp kForever = Timestamp::max();
constexpr Duration kImuLead = 7ms;  // the IMU starts this long before the first column

/** Returns make(). Its std::invalid_argument is thrown again with the name of the option before the message. */
template <typename Make>
auto ofLidar(std::size_t place, const char* key, Make&& make) -> decltype(make())
{
  try
  {
    return make();
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(fmt::format("[simulated_lidars] lidar{}_{}: {}", place + 1, key, error.what()));
  }
}

void setWindow(OusterMetadata& metadata, const std::string& text)
{
  std::istringstream stream(text);
  int first = 0, last = 0;
  const bool complete(stream >> first >> last);
  const auto is_column = [&](int column) { return column >= 0 && column < metadata.columns_per_frame; };
  if (!complete || !is_column(first) || !is_column(last))
    throw std::invalid_argument(
        fmt::format("'{}' must be two columns between 0 and {}", text, metadata.columns_per_frame - 1));
  metadata.first_column = first;
  metadata.last_column = last;
}

const std::string& orElse(const std::string& text, const std::string& other) { return text.empty() ? other : text; }

OusterMetadata unitOf(const SimulatedLidarOptions& options, const SimulatedLidarOptions& first, std::size_t place,
                      std::uint64_t seed)
{
  const OusterUnit usual;
  Random random(seed, RandomStream::LidarTiming, place, 1);
  if (!options.metadata.empty())
  {
    OusterMetadata metadata = ofLidar(place, "metadata", [&] { return loadOusterMetadata(options.metadata); });
    if (!options.mode.empty()) ofLidar(place, "mode", [&] { setMode(metadata, options.mode); });
    if (!options.profile.empty()) ofLidar(place, "profile", [&] { setProfile(metadata, options.profile); });
    return metadata;
  }
  OusterUnit unit;
  unit.model = orElse(options.model, orElse(first.model, usual.model));
  unit.mode = orElse(options.mode, orElse(first.mode, usual.mode));
  unit.profile = orElse(options.profile, orElse(first.profile, usual.profile));
  unit.serial = fmt::format("122150000{}{:02}", place + 1, place + 1);
  unit.init_id = static_cast<std::uint32_t>(1'000'000 + random.uniform(0, 8e6));
  return ofLidar(place, "model", [&] { return assumedOuster(unit); });
}

OusterMetadata metadataOf(const SimulatedLidarOptions& options, const SimulatedLidarOptions& first, std::size_t place,
                          std::uint64_t seed)
{
  OusterMetadata metadata = unitOf(options, first, place, seed);
  if (!options.window.empty()) ofLidar(place, "window", [&] { setWindow(metadata, options.window); });
  if (options.metadata.empty() || options.port > 0 || metadata.lidar_port == 0)
  {
    metadata.lidar_port = static_cast<std::uint16_t>(options.port > 0 ? options.port : kOusterLidarPort + 2 * place);
    metadata.imu_port = static_cast<std::uint16_t>(metadata.lidar_port + 1);
  }
  return metadata;
}

LidarTiming timingOf(const SimulatedLidarOptions& options, const OusterMetadata& metadata, Timestamp start,
                     std::size_t place, std::uint64_t seed)
{
  Random random(seed, RandomStream::LidarTiming, place, 0);
  const int packets_per_frame = metadata.columns_per_frame / metadata.columns_per_packet;
  const LidarClockOptions& clock = options.clock;
  LidarTiming timing;
  timing.start = start;
  timing.first_column = fromSeconds(random.uniform(0.01, 0.1));
  timing.rate_error_ppm = clock.rate_error_ppm;
  timing.first_measurement_id =
      static_cast<std::uint16_t>(metadata.columns_per_packet * static_cast<int>(random.uniform(0, packets_per_frame)));
  const double drawn = random.uniform(0, 60000);
  timing.first_frame_id = static_cast<std::uint32_t>(clock.first_frame_id < 0 ? drawn : clock.first_frame_id);
  timing.clock = {fromSeconds(clock.clock_offset), clock.clock_drift_ppm, fromSeconds(clock.clock_jump),
                  fromSeconds(clock.clock_jump_at)};
  return timing;
}

/** After a restart at this time clock, frame ids and columns count from zero. */
LidarTiming afterRestart(LidarTiming timing, Duration at)
{
  timing.first_column = at;
  timing.first_frame_id = 0;
  timing.first_measurement_id = 0;
  timing.clock = {};
  timing.clock.offset = -(timing.start + at).time_since_epoch();
  return timing;
}

void refuseSharedPorts(const std::vector<LidarStation>& stations)
{
  std::set<std::uint16_t> ports;
  std::set<std::string> names;
  for (const LidarStation& station : stations)
  {
    const OusterMetadata& metadata = station.metadata();
    if (!ports.insert(metadata.lidar_port).second || !ports.insert(metadata.imu_port).second)
      throw std::invalid_argument(
          fmt::format("[simulated_lidars] lidar{0}_port: another lidar has port {1} or {2} as well: "
                      "set lidar{0}_port = {3}",
                      station.place + 1, metadata.lidar_port, metadata.imu_port, kOusterLidarPort + 2 * station.place));
    if (fileNameOf(station.name) != station.name)
      throw std::invalid_argument(fmt::format(
          "[simulated_lidars] lidar{}_name = '{}': is also the name of a file: it takes no '/', '\\', '%' or "
          "control character, and no '.' in front",
          station.place + 1, fileNameOf(station.name)));
    if (station.name.empty() || !names.insert(station.name).second)
      throw std::invalid_argument(
          fmt::format("[simulated_lidars] lidar{}_name = '{}': must be given, and different for each lidar",
                      station.place + 1, station.name));
  }
}
}  // namespace

std::vector<SimulatedLidarOptions> dualOs0()
{
  SimulatedLidarOptions left, right;
  left.name = "left";
  left.model = "OS0-32";
  left.mode = "512x10";
  left.profile = "RNG15_RFL8_NIR8";
  left.pose = "1.5 1.2 2.5 30 15 -25";
  left.clock.rate_error_ppm = -40;
  right.name = "right";
  right.pose = "1.5 -1.2 2.5 -30 15 25";
  right.clock.rate_error_ppm = 35;
  right.clock.first_frame_id = 65500;  // wraps soon after the start: what a real one does once in two hours
  return {left, right};
}

std::vector<LidarStation> makeLidarStations(const SimulationSettings& settings, const RecordingSpan& span,
                                            std::uint64_t seed)
{
  std::vector<LidarStation> stations;
  for (std::size_t place = 0; place < settings.lidars.size(); ++place)
  {
    const SimulatedLidarOptions& options = settings.lidars[place];
    const LidarFaultOptions& faults = options.faults;
    const Rigid body_T_sensor = ofLidar(place, "pose", [&] { return parsePose(options.pose); });
    const Rigid error = ofLidar(place, "pose_error", [&] { return parsePose(faults.pose_error); });
    OusterMetadata metadata = metadataOf(options, settings.lidars.front(), place, seed);
    const auto run = [&](const LidarTiming& timing, Timestamp until, std::uint64_t number)
    {
      const std::uint64_t own = place + (number << 16);  // random numbers of its own
      const ImuSetup imu{body_T_sensor * rigidFromMillimetres(metadata.imu_to_sensor_mm),
                         span.start + timing.first_column - (number == 0 ? kImuLead : 0ms),
                         settings.lidar_imu,
                         timing.clock,
                         RandomStream::LidarImu,
                         own};
      const SimulatedLidar lidar = ofLidar(place, "model",
                                           [&] {
                                             return SimulatedLidar(metadata, body_T_sensor, timing, settings.ranging,
                                                                   settings.precipitation, seed, own);
                                           });
      return LidarRun{lidar, until, imu};
    };

    LidarStation station{options.name, place, {}, faults, body_T_sensor * error};
    const LidarTiming timing = timingOf(options, metadata, span.start, place, seed);
    const bool restarts = faults.restart_at > 0;
    const Duration ends = fromSeconds(faults.restart_at), again = ends + fromSeconds(faults.restart_takes);
    station.runs.push_back(run(timing, restarts ? span.start + ends : kForever, 0));
    if (restarts)
    {
      metadata.init_id = metadata.init_id.value_or(0) + 1;
      station.runs.push_back(run(afterRestart(timing, again), kForever, 1));
    }
    stations.push_back(std::move(station));
  }
  refuseSharedPorts(stations);
  return stations;
}
}  // namespace scanloom
