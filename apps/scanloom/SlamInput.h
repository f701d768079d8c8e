/** What `slam` reads: its settings, and its sensors. `doctor` reads rawlogs and clouds in the same way. */
#pragma once
#include "Arguments.h"
#include "input/rig/RecordingFiles.h"
#include "input/rig/SensorInput.h"
#include "mrpt/maps/OctoMapExport.h"
#include "run/run/OutputOptions.h"
#include "run/run/SlamRun.h"

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
  std::uint64_t megabytes = 0;  // 0: not known
  bool live = false;
};

/**
 * The rawlog or the clouds of `files`, or the rig of the configuration, which reads the captures or live lidars.
 * @param lidars names of those to use; empty: all.
 * @param body_imu_ahead of captures (Rig).
 */
SlamInput openInput(const RecordingFiles& files, const std::vector<std::string>& lidars, const Configuration&,
                    Duration body_imu_ahead = {});

/** Throws ConfigError if the settings name an IMU that the input does not have. */
void refuseUnknownImu(const SlamInput&, const SlamOptions&);
}  // namespace scanloom
