/** `scanloom config`: prints all parameters, as a configuration file or as a page of the manual. */
#include "Options.h"
#include "Ros2.h"
#include "Verb.h"
#include "base/config/Names.h"
#include "base/core/ConfigError.h"
#include "base/core/Interruption.h"
#include "base/core/Text.h"
#include "diagnosis/DoctorFindings.h"
#include "diagnosis/Listening.h"
#include "input/rig/RecognisedRig.h"
#include "input/rig/RigOptions.h"
#include "warn.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <sstream>
#include <string_view>
#include <utility>

namespace scanloom
{
namespace
{
constexpr const char *kUsers = "users", *kLaboratory = "laboratory";  // parts of the manual

struct ConfigArguments
{
  std::string default_of;
  std::vector<std::filesystem::path> recording;
  std::string parameters;  // empty: not wanted
  bool ros2 = false;
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

bool isOfLaboratory(const Verb& verb) { return verb.name == "simulate" || verb.name == "experiment"; }

std::string tableOfVerbs(const std::vector<Verb>& shown)
{
  std::string table = "| verb | sections |\n|---|---|\n";
  for (const Verb& verb : shown)
  {
    std::vector<std::string> sections;
    for (const auto& described : verb.schema) sections.push_back(fmt::format("[{}]", described.section.name));
    table += fmt::format("| `{}` | {} |\n", verb.name, fmt::join(sections, ", "));
  }
  return table;
}

/** The keys that people turn first, in this order, as rows of a table. */
std::string tableOfFirstKeys(const Schema& known)
{
  constexpr std::pair<std::string_view, std::string_view> kFirst[] = {
      {"lidars", "extrinsics"}, {"lidars", "lidar1_time_offset"},
      {"lidars", "scan_rate"},  {"lidars", "deadline_ms"},
      {"slam", "imu"},          {"crop", "min_x"},
      {"crop", "max_range"},    {"map_cells", "cell_size"},
      {"output", "maps"},       {"output", "dense_map"},
  };
  std::string table = "| key | default | meaning |\n|---|---|---|\n";
  for (const auto& [section, key] : kFirst)
    for (const SectionDescription& described : known)
      for (const FieldDescription& field : described.fields)
        if (described.section.name == section && field.field.name == key)
          table += fmt::format("| `{}.{}` | {} | {} |\n", section, key, field.value, inWords(field));
  return table;
}

std::string parametersPage(const std::string& part)
{
  const bool laboratory = part == kLaboratory;
  std::vector<Verb> shown;
  Schema known;
  for (const Verb& verb : verbs())
  {
    if (verb.schema.empty() || isOfLaboratory(verb) != laboratory) continue;
    shown.push_back(verb);
    merge(known, verb.schema);
  }
  const std::string head =
      laboratory
          ? "# Parameters of the laboratory\n\n"
            "Written by `scanloom config --parameters laboratory`. [simulation.md](simulation.md) and "
            "[study.md](study.md) explain them; those of all other verbs: [parameters.md](parameters.md).\n\n"
          : "# Parameters\n\n"
            "Written by `scanloom config --parameters`. [configuration.md](configuration.md) explains the files; "
            "keys of `simulate` and `experiment`: [laboratory_parameters.md](laboratory_parameters.md).\n\n"
            "The ten that people turn first, as `--set section.key=value`:\n\n" +
                tableOfFirstKeys(known) + "\n";
  return head + tableOfVerbs(shown) + "\n" + toMarkdown(known);
}

/** Of the file into which standard output goes, else the current one: a configuration's paths are relative to it. */
std::filesystem::path folderOfOutput()
{
  std::error_code not_open;
  const std::filesystem::path output = std::filesystem::read_symlink("/proc/self/fd/1", not_open);
  return std::filesystem::is_regular_file(output, not_open) ? output.parent_path() : std::filesystem::current_path();
}

/** The section [crop] with a box around the machine, by what stays in place in the body frame while it drives. */
std::string cropSectionOf(const RecognisedRig& recognised, const std::filesystem::path& ini_folder)
{
  constexpr Duration kLookedAt = 120s;  // of the recording: longer than most stand before they drive
  if (!recognised.unknown_poses.empty()) return "";
  auto ini = Configuration::fromText(recognised.ini, (ini_folder / "recognised").string());
  makeRigPathsAbsolute(ini);
  const Rig rig = makeRig(readRigSettings(ini, kRecognisedSection));
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
  const std::filesystem::path folder = folderOfOutput();
  const RecognisedRig rig = recogniseRig(files, folder);
  for (const std::string& note : rig.notes) warn(printable(note));
  catchInterruption();
  std::cout << rig.ini << cropSectionOf(rig, folder);
  return kDone;
}

/** The configuration of live sensors. */
std::string withoutCapture(const std::string& ini)
{
  std::string live;
  std::istringstream lines(ini);
  for (std::string line; std::getline(lines, line);)
    if (!beginsWith(line, "pcap_input")) live += line + '\n';
  return live;
}

/** Of topics: they are live, so the configuration names no file. */
int printRigOnTopics()
{
  RecordingArguments topics;
  const std::unique_ptr<HeardTopics> heard = hearInstead(true, 10s, topics);
  const RecordingFiles files = filesOf(topics);
  const std::filesystem::path folder = folderOfOutput();
  const RecognisedRig rig = recogniseRig(files, folder);
  for (const std::string& note : rig.notes) warn(printable(note));
  std::cout << withoutCapture(rig.ini);
  return kDone;
}

int run(const ConfigArguments& arguments)
{
  if (arguments.ros2) return printRigOnTopics();
  if (!arguments.recording.empty()) return printRigOf(arguments.recording);
  if (!arguments.parameters.empty())
    std::cout << parametersPage(arguments.parameters);
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
  addFlag(app, "--ros2", arguments->ros2, "the same for the lidars whose topics are heard on ROS 2 now");
  addOption(app, "--parameters", arguments->parameters,
            "print the parameters of all verbs as Markdown, those of simulate and experiment as 'laboratory'")
      .optionalValue(kUsers)
      .oneOf({kUsers, kLaboratory})
      .typeName("PART");
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
