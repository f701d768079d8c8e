/** Reads and checks the whole configuration of a verb. */
#pragma once
#include "Arguments.h"
#include "Recording.h"
#include "Verb.h"
#include "input/rig/RigOptions.h"
#include "warn.h"

namespace scanloom
{
template <typename Settings>
struct Loaded
{
  Configuration configuration;
  Settings settings;
  RecordedSensors sensors;
};

/** The settings of a configuration with --set on top. @throws ConfigError as load() does. */
template <typename Settings>
Loaded<Settings> loadFrom(Configuration configuration, const std::vector<std::string>& assignments,
                          const RecordedSensors& sensors = {})
{
  for (const std::string& assignment : assignments) configuration.set(assignment);
  for (const SectionDescription& described : knownToAnyVerb()) configuration.makePathsAbsolute(described);
  makeRigPathsAbsolute(configuration);
  Settings settings = readSettings<Settings>(configuration, knownToAnyVerb());
  return {std::move(configuration), std::move(settings), sensors};
}

/**
 * From -c, then the recording, then --set. @throws ConfigError with all problems: wrong values, and names that no verb
 * knows; and what recognising the recording throws.
 */
template <typename Settings>
Loaded<Settings> load(const ConfigurationArguments& arguments, const RecordingFiles& recording = {},
                      Poses poses = Poses::Needed, const Messages& messages = {})
{
  Configuration configuration = Configuration::fromFiles(arguments.files);
  const bool holds_its_own = !recording.rawlogs.empty() || !recording.clouds.empty();
  for (const std::string& assignment : arguments.assignments)
    if (holds_its_own && assignment.rfind("lidars.", 0) == 0)
      messages.warn(fmt::format("--set {} is not used: it is for captures and live lidars", assignment));
  const RecordedSensors sensors = addCaptures(recording, configuration, poses, messages);
  return loadFrom<Settings>(std::move(configuration), arguments.assignments, sensors);
}

/** The INI file that repeats the run: --dry-run prints it, and it is written beside the results. */
template <typename Settings>
std::string toIni(const Loaded<Settings>& loaded)
{
  return toIni(schemaOf(loaded.settings), loaded.configuration);
}
}  // namespace scanloom
