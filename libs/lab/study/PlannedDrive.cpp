#include "lab/study/PlannedDrive.h"

#include "base/config/Names.h"
#include "lab/study/ContentHash.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace scanloom
{
namespace
{
PlannedDrive driveOf(const PlannedRun& run)
{
  PlannedDrive drive;
  drive.stand = run.stand;
  drive.simulation = run.simulation;
  drive.recording = run.recording;
  drive.seed = run.seed;
  if (drive.simulated())
    std::copy_if(run.settings.begin(), run.settings.end(), std::back_inserter(drive.settings),
                 [](const auto& setting) { return changesTheDrive(setting.first); });
  return drive;
}

bool shared(const PlannedDrive& a, const PlannedDrive& b)
{
  return a.simulated() && a.simulation == b.simulation && a.seed == b.seed && a.settings == b.settings;
}

std::string driveHash(const PlannedDrive& drive, const std::string& version)
{
  std::string all = version + '\n' + drive.label() + '\n';
  for (const auto& [name, value] : drive.settings) all += fmt::format("{}={}\n", name, value);
  if (drive.simulated()) all += contentOf(drive.simulation);
  return hashOf(all);
}
}  // namespace

std::string PlannedDrive::label() const { return seed > 0 ? fmt::format("{} seed {}", stand, seed) : stand; }

bool changesTheDrive(const std::string& setting)
{
  constexpr std::string_view kSimulation = "simulated_";
  return sameName(std::string_view(setting).substr(0, kSimulation.size()), kSimulation);
}

std::vector<std::pair<std::string, std::string>> settingsOfSlam(const PlannedRun& run)
{
  auto settings = run.settings;
  settings.erase(std::remove_if(settings.begin(), settings.end(),
                                [](const auto& setting) { return changesTheDrive(setting.first); }),
                 settings.end());
  return settings;
}

std::vector<PlannedDrive> drivesOf(const std::vector<PlannedRun>& runs, const std::string& version)
{
  std::vector<PlannedDrive> drives;
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    PlannedDrive drive = driveOf(runs[i]);
    auto found =
        std::find_if(drives.begin(), drives.end(), [&](const PlannedDrive& other) { return shared(drive, other); });
    if (found == drives.end())
    {
      drive.hash = driveHash(drive, version);
      found = drives.insert(drives.end(), std::move(drive));
    }
    found->runs.push_back(i);
  }
  return drives;
}
}  // namespace scanloom
