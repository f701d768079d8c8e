/** Which input a recording or a configuration names: the one place that decides it, for all verbs. */
#pragma once
#include "base/config/Configuration.h"
#include "input/rig/RecordingFiles.h"
#include "input/rig/Rig.h"
#include "input/rig/SensorInput.h"

#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
/** A rawlog of scans, clouds, or a rig: its captures and bags, or its live sensors. */
struct InputSource
{
  std::filesystem::path rawlog{};               // empty: it is none
  RecordingFiles::Paths clouds{};               // empty: they are none
  std::vector<std::string> lidars_of_rawlog{};  // names of those to use; empty: all
  Rig rig{};                                    // of neither
  DriverOptions driver{};                       // of the rig's section

  bool isLive() const { return rawlog.empty() && clouds.empty() && rig.captures.empty(); }
};

/**
 * The rawlog or the clouds of `files`, otherwise the rig of the configuration.
 * @param lidars names of those to use; empty: all.
 * Throws UsageError for lidars of clouds, which do not tell them apart, ConfigError as rigSection() and makeRig() do.
 */
InputSource sourceOf(const RecordingFiles& files, const Configuration&, const std::vector<std::string>& lidars = {});

/** Files are read ahead, by a thread of their own. Throws what the constructors of the inputs throw. */
std::unique_ptr<SensorInput> openInput(const InputSource&);
}  // namespace scanloom
