#include "lab/study/DriveRecording.h"

#include <exception>
#include <system_error>

namespace scanloom
{
Command simulateCommand(const PlannedDrive& drive, const std::filesystem::path& folder)
{
  std::vector<std::string> words{ownExecutable(),  "simulate", "-c",
                                 drive.simulation, "--seed",   std::to_string(drive.seed)};
  addSettings(words, drive.settings);
  words.insert(words.end(), {"--out-dir", folder});
  return {words, {}};
}

std::string simulateDrive(const PlannedDrive& drive, const std::filesystem::path& folder)
try
{
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  runVerb(simulateCommand(drive, folder), folder / "log.txt");
  return "";
}
catch (const std::exception& e)
{
  return e.what();
}

void removePackets(const std::filesystem::path& folder)
{
  std::error_code ignored;
  for (const char* name : {"recording.pcap", "recording.rawlog", "imu.csv"})
    std::filesystem::remove(folder / name, ignored);
}
}  // namespace scanloom
