#include "lab/study/internal/RunHash.h"

#include "input/rig/RecordingFiles.h"
#include "lab/study/ContentHash.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace scanloom
{
namespace
{
std::vector<std::filesystem::path> filesIn(const std::filesystem::path& recording)
{
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(recording))
  {
    const RecordingFiles found = filesOf({recording});
    for (const auto* list :
         {&found.captures, &found.rawlogs, &found.clouds, &found.metadata, &found.imus, &found.extrinsics})
      files.insert(files.end(), list->begin(), list->end());
    return files;
  }
  for (const auto& entry : std::filesystem::directory_iterator(recording))
    if (entry.is_regular_file()) files.push_back(entry.path());
  return files;
}

std::string namesAndSizes(const PlannedRun& run)
{
  std::vector<std::string> lines;
  for (const auto& file : filesIn(run.recording))
    lines.push_back(fmt::format("{} {}", file.filename().string(), std::filesystem::file_size(file)));
  std::sort(lines.begin(), lines.end());
  if (std::filesystem::is_regular_file(run.reference))
    lines.push_back(fmt::format("{} {}", run.reference.string(), std::filesystem::file_size(run.reference)));
  return fmt::format("{}", fmt::join(lines, "\n"));
}
}  // namespace

std::string configurationHash(const PlannedRun& run, const ExperimentPlan& plan, const std::string& version)
{
  std::string all = version + '\n' + run.label() + '\n';
  for (const auto& [name, value] : run.settings) all += fmt::format("{}={}\n", name, value);
  for (const auto& file : plan.configurations) all += contentOf(file) + '\n';
  all += run.recording.empty() ? contentOf(run.simulation) : namesAndSizes(run);
  return hashOf(all);
}
}  // namespace scanloom
