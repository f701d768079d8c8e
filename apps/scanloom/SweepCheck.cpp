#include "SweepCheck.h"

#include "Mistakes.h"
#include "Recording.h"
#include "Settings.h"
#include "SlamInput.h"
#include "base/core/ConfigError.h"
#include "base/core/ScratchFolder.h"
#include "lab/simulation/RecordingFolder.h"
#include "lab/simulation/checkedScene.h"
#include "lab/study/PlannedDrive.h"
#include "lab/study/RunReference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <system_error>

namespace scanloom
{
namespace
{
/** What configurations read as $env{SCANLOOM_RECORDING}, while it lives. */
class RecordingVariable
{
 public:
  explicit RecordingVariable(const std::filesystem::path& drive) { ::setenv(kName, drive.c_str(), 1); }
  RecordingVariable(const RecordingVariable&) = delete;
  RecordingVariable& operator=(const RecordingVariable&) = delete;
  ~RecordingVariable() { ::unsetenv(kName); }

 private:
  static constexpr const char* kName = "SCANLOOM_RECORDING";
};

/** The first second of a drive. */
class ShortDrive
{
 public:
  explicit ShortDrive(const Scene& scene) : folder_(std::filesystem::temp_directory_path(), "scanloom_drive")
  {
    writeRecording(scene, folder_.path(), [](double) {});
  }
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  ScratchFolder folder_;
};

std::vector<std::string> assignmentsOf(const std::vector<std::pair<std::string, std::string>>& settings)
{
  std::vector<std::string> assignments;
  for (const auto& [name, value] : settings) assignments.push_back(name + '=' + value);
  return assignments;
}

/** Runs that read the same packets. */
using Runs = std::vector<const PlannedRun*>;

bool sameDrive(const PlannedRun& a, const PlannedRun& b)
{
  const auto of_drive = [](const PlannedRun& run)
  {
    std::vector<std::pair<std::string, std::string>> settings;
    std::copy_if(run.settings.begin(), run.settings.end(), std::back_inserter(settings),
                 [](const auto& setting) { return changesTheDrive(setting.first); });
    return settings;
  };
  return a.simulation == b.simulation && a.recording == b.recording && a.reference == b.reference &&
         (!a.recording.empty() || of_drive(a) == of_drive(b));
}

/** Seeds and N make no mistakes: one run of each other combination. */
std::vector<Runs> byDrive(const std::vector<PlannedRun>& runs)
{
  std::vector<Runs> drives;
  for (const PlannedRun& run : runs)
  {
    auto drive =
        std::find_if(drives.begin(), drives.end(), [&](const Runs& others) { return sameDrive(*others.front(), run); });
    if (drive == drives.end()) drive = drives.insert(drive, Runs{});
    const bool known = std::any_of(drive->begin(), drive->end(),
                                   [&](const PlannedRun* other)
                                   { return other->lidars == run.lidars && other->settings == run.settings; });
    if (!known) drive->push_back(&run);
  }
  return drives;
}

std::vector<std::string> namesIn(const std::string& lidars)
{
  std::vector<std::string> names;
  if (lidars == kAllLidars) return names;
  for (std::size_t begin = 0; begin <= lidars.size();)
  {
    const std::size_t end = std::min(lidars.find(',', begin), lidars.size());
    names.push_back(lidars.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

void openAsRun(const Loaded<SlamVerbSettings>& loaded, const RecordingFiles& files, const std::string& lidars)
{
  const InputSource source = sourceOf(files, loaded.configuration, namesIn(lidars));
  if (source.isLive())
    throw UsageError(fmt::format("[{}] pcap_input is not set: the runs would wait for live lidars",
                                 rigSection(loaded.configuration)));
  refuseUnknownImu(*openInput(source), loaded.settings.slam);
}

/** The command of a run has it already. */
void refuseEveryNth(const PlannedRun& run)
{
  for (const auto& [name, value] : run.settings)
    if (name == "slam.every_nth")
      throw ConfigError("[slam] every_nth is a key of [experiment] in a sweep: give it there");
}

void checkSlam(const Runs& runs, const ExperimentPlan& plan, const std::filesystem::path& drive, Mistakes& mistakes)
{
  const PlannedRun& first = *runs.front();
  const bool recorded = !first.recording.empty();
  const std::string key = recorded ? "recordings" : "simulations";
  const std::string value = (recorded ? first.recording : first.simulation).string();
  const RecordingVariable variable(drive);
  RecordingFiles files;
  Configuration configuration;
  const bool recognised = mistakes.inRunsWith(key, value,
                                              [&]
                                              {
                                                auto configurations = plan.configurations;
                                                if (!recorded) configurations.push_back(first.simulation);
                                                configuration = Configuration::fromFiles(configurations);
                                                if (findTheDrive(plan.configurations)) return;
                                                files = filesOf(RecordingArguments{{drive}, {}}, Clouds::Taken);
                                                addCaptures(files, configuration);
                                              });
  if (!recognised) return;
  for (const PlannedRun* run : runs)
  {
    mistakes.inSettings([&] { refuseEveryNth(*run); });
    std::optional<Loaded<SlamVerbSettings>> loaded;
    mistakes.inSettings([&]
                        { loaded = loadFrom<SlamVerbSettings>(configuration, assignmentsOf(settingsOfSlam(*run))); });
    if (loaded)
      mistakes.inRunsWith("lidars", fmt::format("{}, {} = {}", run->lidars, key, value),
                          [&] { openAsRun(*loaded, files, run->lidars); });
  }
}

void checkRecording(const Runs& runs, const ExperimentPlan& plan, Mistakes& mistakes)
{
  const PlannedRun& run = *runs.front();
  const std::string reference = run.reference.empty() ? run.recording.string() : run.reference.string();
  mistakes.inRunsWith(run.reference.empty() ? "recordings" : "references", reference,
                      [&] { referenceOf(run.recording, run.reference); });
  checkSlam(runs, plan, std::filesystem::absolute(run.recording), mistakes);
}

void checkSimulation(const Runs& runs, const ExperimentPlan& plan, Mistakes& mistakes)
{
  const PlannedRun& run = *runs.front();
  std::optional<ShortDrive> drive;
  mistakes.inSettings(
      [&]
      {
        std::vector<std::pair<std::string, std::string>> settings;
        std::copy_if(run.settings.begin(), run.settings.end(), std::back_inserter(settings),
                     [](const auto& setting) { return changesTheDrive(setting.first); });
        SimulationSettings simulation =
            load<SimulationSettings>({{run.simulation}, assignmentsOf(settings), false}).settings;
        checkedScene(simulation, run.seed);
        simulation.drive.duration = std::min(simulation.drive.duration, 1.0);
        drive.emplace(checkedScene(simulation, run.seed));
      });
  if (drive) checkSlam(runs, plan, drive->folder(), mistakes);
}
}  // namespace

void refuseMistakes(const ExperimentPlan& plan, const Configuration& given)
{
  Mistakes mistakes(given.place("experiment", plan.recordings.empty() ? "simulations" : "recordings").file);
  for (const Runs& runs : byDrive(plan.runs))
    if (runs.front()->recording.empty())
      checkSimulation(runs, plan, mistakes);
    else
      checkRecording(runs, plan, mistakes);
  mistakes.refuseAny();
}
}  // namespace scanloom
