/** What `slam` reads: its settings, and its sensors. `doctor` reads rawlogs and clouds in the same way. */
#pragma once
#include "Arguments.h"
#include "maps/OctoMapExport.h"
#include "recordings/RecordingFiles.h"
#include "rig/SensorInput.h"
#include "run/OutputOptions.h"
#include "run/SlamRun.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
struct SlamVerbSettings : SlamSettings
{
  OutputOptions output;
  OctoMapOptions octomap;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    SlamSettings::sections(s, visit);
    visit(s.output, Section{"output", "the files that 'slam' writes"});
    visit(s.octomap, Section{"octomap", "the occupancy map (OctoMap)"});
  }
};

struct SlamInput
{
  std::unique_ptr<SensorInput> sensors;
  std::uint64_t size = 0;  // 0: not known
  const char* unit = "MB";
  bool live = false;
};

/**
 * The rawlog or the clouds of `files`, the scene, or the rig of the configuration, which reads the captures or live
 * lidars.
 * @param lidars names of those to use; empty: all.
 * @param body_imu_ahead of captures (Rig).
 */
SlamInput openInput(const RecordingFiles& files, const SceneArguments&, const std::vector<std::string>& lidars,
                    const Configuration&, Duration body_imu_ahead = {});

/** Throws ConfigError if the settings name an IMU that the input does not have. */
void refuseUnknownImu(const SlamInput&, const SlamOptions&);
}  // namespace scanloom
