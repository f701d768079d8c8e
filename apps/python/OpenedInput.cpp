#include "OpenedInput.h"

#include "Recording.h"
#include "Settings.h"

namespace scanloom
{
OpenedInput openInput(const InputArguments& arguments)
{
  OpenedInput opened;
  const Messages messages{[&](const std::string& text) { opened.warnings.push_back(text); },
                          [&](const std::string& text) { opened.notes.push_back(text); }};
  RecordingFiles files;
  if (!arguments.recording.empty()) files = filesOf({arguments.recording, arguments.metadata}, Clouds::Taken, messages);
  const ConfigurationArguments configured{arguments.configurations, arguments.assignments};
  const auto loaded = load<SlamVerbSettings>(configured, files, Poses::Needed, messages);
  opened.input = openForSlam(sourceOf(files, loaded.configuration, arguments.lidars), loaded.configuration);
  opened.settings = loaded.settings;
  opened.sensors_not_used = loaded.sensors.not_used;
  return opened;
}
}  // namespace scanloom
