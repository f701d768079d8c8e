/** `scanloom config`: prints all parameters, as a configuration file or as a page of the manual. */
#include "Options.h"
#include "Verb.h"
#include "base/config/Names.h"
#include "base/core/ConfigError.h"
#include "base/core/Interruption.h"
#include "base/core/printable.h"
#include "diagnosis/DoctorFindings.h"
#include "diagnosis/Listening.h"
#include "input/rig/RecognisedRig.h"
#include "warn.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct ConfigArguments
{
  std::string default_of;
  std::vector<std::filesystem::path> recording;
  bool parameters = false;
};

const Verb& verbNamed(const std::string& name)
{
  std::vector<std::string> configurable;
  for (const Verb& verb : verbs())
  {
    if (verb.schema.empty()) continue;
    if (verb.name == name) return verb;
    configurable.push_back(verb.name);
  }
  throw UsageError(fmt::format("--default {}: is no verb with parameters; {}", name, suggestion(name, configurable)));
}

std::string parametersPage()
{
  std::string page =
      "# Parameters\n\n"
      "Written by `scanloom config --parameters`. [configuration.md](configuration.md) explains the files.\n\n"
      "| verb | sections |\n|---|---|\n";
  for (const Verb& verb : verbs())
  {
    if (verb.schema.empty()) continue;
    std::vector<std::string> sections;
    for (const auto& described : verb.schema) sections.push_back(fmt::format("[{}]", described.section.name));
    page += fmt::format("| `{}` | {} |\n", verb.name, fmt::join(sections, ", "));
  }
  return page + "\n" + toMarkdown(knownToAnyVerb());
}

/** Of the file into which standard output goes, else the current one: a configuration's paths are relative to it. */
std::filesystem::path folderOfOutput()
{
  std::error_code not_open;
  const std::filesystem::path output = std::filesystem::read_symlink("/proc/self/fd/1", not_open);
  return std::filesystem::is_regular_file(output, not_open) ? output.parent_path() : std::filesystem::current_path();
}

/** The section [crop] with a box around the machine, by what stays in place in the body frame while it drives. */
std::string cropSectionOf(const RecordingFiles& files)
{
  constexpr Duration kLookedAt = 120s;  // of the recording: longer than most stand before they drive
  const RecognisedRig recognised = recogniseRig(files);
  if (!recognised.unknown_poses.empty()) return "";
  const Rig rig = makeRig(readRigSettings(Configuration::fromText(recognised.ini, "recognised"), kRecognisedSection));
  RigListener listener(rig, true);
  listenToCaptures(rig, kLookedAt, listener, [](double) { return !interrupted(); });
  const SelfReturns machine = examine(listener.finish(), {}).machine;
  const Finding finding = cropFinding(machine);
  if (finding.verdict <= Verdict::Ok) return fmt::format("\n// [crop], a box around the machine: {}\n", finding.says);
  return fmt::format("\n[crop]\n// {}\n{}\n", finding.says, cropKeys(machine.box, "\n"));
}

int printRigOf(const std::vector<std::filesystem::path>& recording)
{
  const RecordingFiles files = filesOf(recording);
  if (files.captures.empty())
    throw UsageError(fmt::format("{}: only captures need a configuration of their lidars", recording.front().string()));
  const RecognisedRig rig = recogniseRig(files, folderOfOutput());
  for (const std::string& note : rig.notes) warn(printable(note));
  catchInterruption();
  std::cout << rig.ini << cropSectionOf(files);
  return kDone;
}

int run(const ConfigArguments& arguments)
{
  if (!arguments.recording.empty()) return printRigOf(arguments.recording);
  if (arguments.parameters)
    std::cout << parametersPage();
  else
    std::cout << toIni(verbNamed(arguments.default_of).schema);
  return kDone;
}

std::function<int()> addConfigOptions(CLI::App& app)
{
  auto arguments = std::make_shared<ConfigArguments>();
  addOption(app, "--default", arguments->default_of,
            "print a commented configuration file with the defaults of this verb")
      .typeName("VERB");
  addOption(app, "--for", arguments->recording,
            "print a configuration file for these captures: lidars, ports, metadata, poses and IMU as recognised; what "
            "must be filled in is marked")
      .typeName("FILE...");
  addFlag(app, "--parameters", arguments->parameters, "print the parameters of all verbs, as Markdown");
  requireOneOption(app);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb configVerb()
{
  return {"config",
          "a configuration file for a recording, defaults of a verb, the manual of all parameters",
          {},
          &addConfigOptions};
}
}  // namespace scanloom
