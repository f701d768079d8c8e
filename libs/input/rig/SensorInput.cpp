#include "input/rig/SensorInput.h"

#include "input/rig/Rig.h"

#include <fmt/format.h>

namespace scanloom
{
std::map<std::string, std::uint64_t> countsOf(const RigAccount& account)
{
  std::map<std::string, std::uint64_t> counts = account.input;
  if (account.lidars.empty()) return counts;
  for (const LidarAccount& lidar : account.lidars)
  {
    forEachCount(lidar.counters, [&](const char* name, std::uint64_t count)
                 { counts[fmt::format("{}.{}", lidar.name, name)] = count; });
    counts[fmt::format("{}.packets_of_other_senders", lidar.name)] = lidar.of_other_senders;
  }
  std::uint64_t unmatched = 0;
  for (const auto& [origin, datagrams] : account.unmatched) unmatched += datagrams;
  counts["datagrams_of_no_lidar"] = unmatched;
  counts["imu_samples_late"] = account.late_imu_samples;
  counts["imu_samples_implausible"] = account.implausible_imu_samples;
  return counts;
}

SensorSetup setupOf(const Rig& rig)
{
  SensorSetup setup{recordingHeader(rig), {}};
  if (rig.body_T_imu) setup.body_T_imu[SensorImu::kBody] = *rig.body_T_imu;
  for (LidarIndex i = 0; i < rig.lidars.size(); ++i)
  {
    if (!rig.lidars[i].decoder || !rig.addresses[i].hasImu()) continue;
    const LidarDescription& lidar = rig.lidars[i].decoder->description();
    setup.body_T_imu[static_cast<int>(i)] = lidar.body_T_sensor * lidar.sensor_T_imu;
  }
  return setup;
}

std::optional<SensorEvent> SensorInput::next()
{
  while (!ended())
    if (std::optional<SensorEvent> event = next(1s)) return event;
  return std::nullopt;
}

bool wasReadWhole(const std::map<std::string, std::uint64_t>& counts)
{
  const auto damaged = counts.find(kDamagedInputs);
  return damaged == counts.end() || damaged->second == 0;
}
}  // namespace scanloom
