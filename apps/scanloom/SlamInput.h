/** What `slam` reads: its settings, and its sensors. */
#pragma once
#include "Arguments.h"
#include "mrpt/observations/openInput.h"
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

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    SlamSettings::sections(s, visit);
    visit(s.output, Section{"output", "the files that 'slam' writes"});
  }
};

struct SlamInput
{
  std::unique_ptr<SensorInput> sensors;
  std::uint64_t megabytes = 0;  // 0: not known
  bool live = false;
};

/** The source, live with the IMU that the configuration describes beside the lidars. */
SlamInput openForSlam(const InputSource&, const Configuration&);

/** Throws ConfigError if the settings name an IMU that the input does not have. */
void refuseUnknownImu(const SensorInput&, const SlamOptions&);
}  // namespace scanloom
