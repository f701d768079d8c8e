#include "Program.h"

#include "Verb.h"
#include "Version.h"
#include "base/config/MrptMessage.h"
#include "base/config/Names.h"
#include "base/core/ConfigError.h"
#include "base/core/Text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string_view>

namespace scanloom
{
namespace
{
/** If a standard stream is closed, the next file that is opened would get its number, and our messages. */
void keepStandardStreamsOpen()
{
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
    if (::fcntl(stream, F_GETFD) == -1) ::open("/dev/null", O_RDWR);
}

std::vector<std::string> namesKnownTo(const CLI::App& app)
{
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands(nullptr))
    if (!verb->get_name().empty()) names.push_back(verb->get_name());
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

struct Removed
{
  std::string_view verb, option, instead;
};
constexpr Removed kRemoved[] = {
    {"slam", "--simulate", "write the recording by 'scanloom simulate', then give slam its folder"},
    {"record", "--simulate", "write the recording by 'scanloom simulate', then give record its folder"},
    {"simulate", "--truth", "--out-dir writes the ground truth, too"},
    {"view", "--width", "pictures have 1280 x 960 pixels"},
    {"view", "--height", "pictures have 1280 x 960 pixels"},
    {"map", "--jobs", "taskset -c 0,1 scanloom map ..."},
    {"register", "--config", "nothing: its cells are constants"},
    {"register", "--set", "nothing: its cells are constants"},
    {"register", "--dry-run", "nothing: it writes no file"},
    {"slam", "--window", "--web"},
    {"slam", "-i", "scanloom slam RECORDING"},
    {"slam", "--input", "scanloom slam RECORDING"},
    {"simulate", "--seconds", "--set simulated_drive.duration=S"},
    {"simulate", "--delay", "packets begin 5 s after the configuration is printed"},
    {"simulate", "--jobs", "taskset -c 0,1 scanloom simulate ..."},
    {"doctor", "--dry-run", "nothing: it writes no file"},
    {"calibrate", "--dry-run", "scanloom slam --dry-run, which checks the same keys"},
    {"info", "--digests", "nothing: tests compare every field with the maker's decode"},
    {"map", "--dry-run", "its estimate is printed first; Ctrl-C ends it"},
    {"map", "-q", "scanloom map ... 2>/dev/null"},
    {"map", "--quiet", "scanloom map ... 2>/dev/null"},
    {"map", "--cubes", "scanloom view MAP.bt draws cubes"},
    {"evaluate", "--rpe-delta", "the RPE is over 1 m"},
    {"evaluate", "--rpe-unit", "the RPE is over 1 m"},
    {"evaluate", "--least-coverage", "--fail-if-drift-above demands 90 %"},
    {"register", "--trials", "a loop over --guess"},
    {"register", "--spread-m", "a loop over --guess"},
    {"register", "--spread-deg", "a loop over --guess"},
    {"register", "--spread-yaw-deg", "a loop over --guess"},
    {"register", "--seed", "a loop over --guess"},
    {"register", "--guess-sigma-m", "--guess-sigma \"M DEG\""},
    {"register", "--guess-sigma-deg", "--guess-sigma \"M DEG\""},
    {"record", "--window", "--web"},
    {"edit", "--info", "scanloom info FILE"},
    {"edit", "--check", "scanloom doctor FILE"},
    {"edit", "--from-pcap", "scanloom record FILE"},
    {"edit", "--approach-a", "scanloom simulate --set simulated_recording.whole_turns=nearest"},
    {"edit", "--to-simplemap", "scanloom map -i FILE --trajectory FILE -o MAP.simplemap"},
    {"edit", "--to-octomap", "scanloom map -i FILE --trajectory FILE -o MAP.bt"},
    {"edit", "--keyframe-distance", "scanloom map has it"},
    {"edit", "--octomap-preset", "scanloom map --preset"},
    {"edit", "--export-ply", "--export ply=DIR"},
    {"edit", "--export-pcd", "--export pcd=DIR"},
    {"edit", "--export-kitti", "--export kitti=DIR"},
    {"edit", "--export-csv", "--export csv=DIR"},
    {"edit", "--export-tum", "--export tum=FILE"},
    {"edit", "--imu", "--deskew imu=LABEL"},
    {"edit", "--min-range", "--ranges \"M0 M1\""},
    {"edit", "--max-range", "--ranges \"M0 M1\""},
    {"edit", "--json", "scanloom info --json"},
    {"edit", "--dry-run", "edit checks everything before it writes"},
};

bool isLikeOne(const std::string& argument, const std::vector<std::string>& names)
{
  constexpr std::size_t kTypingErrors = 2;
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return editDistance(argument, name) <= kTypingErrors; });
}

/** What to write instead of an option that was removed, else the names most like it. */
std::string adviceOn(const std::string& argument, const CLI::App& where)
{
  const std::string option = argument.substr(0, argument.find('='));
  for (const Removed& removed : kRemoved)
    if (where.get_name() == removed.verb && option == removed.option)
      return fmt::format("it was removed; instead: {}", removed.instead);
  std::vector<std::string> names = namesKnownTo(where);
  if (isLikeOne(argument, names)) return suggestion(argument, names);
  if (where.get_option_no_throw("-i") && std::filesystem::exists(argument)) return "a file is given as -i FILE";
  if (where.get_parent()) return suggestion(argument, names);
  names.erase(std::remove_if(names.begin(), names.end(), [](const std::string& name) { return name.front() == '-'; }),
              names.end());
  return fmt::format("verbs are {}", fmt::join(names, ", "));
}

int complain(const CLI::App& app, const CLI::ParseError& error)
{
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);  // --help, --version

  const auto chosen = app.get_subcommands();
  const CLI::App& where = chosen.empty() ? app : *chosen.front();
  const std::string name = chosen.empty() ? "scanloom" : "scanloom " + where.get_name();
  const auto unexpected = app.remaining(true);
  if (!unexpected.empty())
    std::cerr << fmt::format("{}: unknown argument {}: {}\n", name, unexpected.front(),
                             adviceOn(unexpected.front(), where));
  else
    std::cerr << fmt::format("{}: {}\n", name, chosen.empty() ? "which verb?" : error.what());
  std::cerr << fmt::format("'{} --help' lists all arguments\n", name);
  return kWrongUsage;
}

int guarded(const std::string& name, const std::function<int()>& run)
try
{
  const int status = run();
  if (!std::cout.flush()) throw std::runtime_error("stdout cannot be written");
  return status;
}
catch (const ConfigError& e)
{
  std::cerr << printableLines(e.what()) << '\n';  // every line begins with its file
  return kWrongUsage;
}
catch (const UsageError& e)
{
  std::cerr << fmt::format("scanloom {}: {}\n", name, printableLines(e.what()));
  return kWrongUsage;
}
catch (const std::exception& e)
{
  std::cerr << fmt::format("scanloom {}: {}\n", name, printableLines(messageIn(e.what())));
  return kFailed;
}

int printHelp(const CLI::App& app, const std::string& verb)
{
  const auto print = [&](const CLI::App& chosen, const std::string& name)
  {
    std::cout << app.get_formatter()->make_help(&chosen, name, CLI::AppFormatMode::Normal);
    return kDone;
  };
  if (verb.empty()) return print(app, app.get_name());
  for (const CLI::App* subcommand : app.get_subcommands(nullptr))
    if (subcommand->get_name() == verb) return print(*subcommand, app.get_name() + " " + verb);
  throw UsageError(fmt::format("{}: is no verb; {}", verb, suggestion(verb, namesKnownTo(app))));
}
}  // namespace

Schema knownToAnyVerb()
{
  Schema known;
  for (const Verb& verb : verbs()) merge(known, verb.schema);
  return known;
}

int runProgram(int argc, const char* const* argv)
{
  keepStandardStreamsOpen();

  CLI::App app(
      "Merges the packets of several lidars into one point cloud per fixed time window, by measurement\n"
      "timestamp; computes trajectories and maps from them.",
      "scanloom");
  app.set_version_flag("--version", fmt::format("scanloom {}", programVersion()));
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.get_formatter()->label("TEXT:FILE", "FILE");
  app.get_formatter()->label("Excludes", "not with");
  app.get_formatter()->label("SUBCOMMAND", "VERB");
  app.footer(
      "Exit status: 0 done; 1 failed; 2 wrong usage or configuration; 3 the result is not good; 4 some runs of an\n"
      "experiment failed; 130 interrupted, and what there was is saved.");

  std::string name;
  std::function<int()> run;
  for (const Verb& verb : verbs())
  {
    CLI::App* subcommand = app.add_subcommand(verb.name, verb.purpose)->group("Verbs");
    subcommand->callback(
        [&, chosen = verb.add(*subcommand), &verb = verb]
        {
          name = verb.name;
          run = chosen;
        });
  }
  std::string explained;
  CLI::App* help = app.add_subcommand("help", "the options of a verb, as its --help")->group("Verbs");
  help->add_option("verb", explained, "the verb; none: the list of verbs")->type_name("VERB");
  help->callback(
      [&]
      {
        name = "help";
        run = [&] { return printHelp(app, explained); };
      });

  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    return complain(app, error);
  }
  return guarded(name, run);
}
}  // namespace scanloom
