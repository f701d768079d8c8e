#include "OpenedInput.h"

#include "Recording.h"
#include "Settings.h"

namespace scanloom
{
OpenedInput openInput(const InputArguments& arguments, ImuSamples imu_samples)
{
  OpenedInput opened;
  const Messages messages{[&](const std::string& text) { opened.warnings.push_back(text); },
                          [&](const std::string& text) { opened.notes.push_back(text); }};
  RecordingFiles files;
  if (!arguments.recording.empty()) files = filesOf({arguments.recording, arguments.metadata}, Clouds::Taken, messages);
  const ConfigurationArguments configured{arguments.configurations, arguments.assignments};
  const auto loaded = load<SlamVerbSettings>(configured, files, Poses::Needed, messages);
  InputSource source = sourceForSlam(files, loaded.configuration, loaded.settings, arguments.lidars);
  if (imu_samples == ImuSamples::InTimeOrder) source.rig.body_imu_ahead = {};
  opened.input = openForSlam(source, loaded.configuration);
  opened.settings = loaded.settings;
  opened.sensors_not_used = loaded.sensors.not_used;
  return opened;
}
}  // namespace scanloom
