#include "lab/study/internal/Study.h"

#include "base/core/OutputFile.h"
#include "base/core/Text.h"
#include "base/core/jsonText.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>
#include <thread>

namespace scanloom
{
namespace
{
constexpr double kLost = std::numeric_limits<double>::infinity();

/** Names of the settings that differ between runs. */
std::set<std::string> varied(const std::vector<RunRecord>& records)
{
  std::set<std::string> names;
  for (const RunRecord& record : records)
    for (std::size_t i = 0; i < record.run.settings.size(); ++i)
      if (record.run.settings[i] != records.front().run.settings[i]) names.insert(record.run.settings[i].first);
  return names;
}

std::string groupOf(const PlannedRun& run, const std::set<std::string>& names)
{
  std::string group = fmt::format("N = {}", run.every_nth);
  for (const auto& [name, value] : run.settings)
    if (names.count(name) > 0) group += fmt::format(", {} = {}", name.substr(name.find('.') + 1), value);
  return group;
}

/** With kLost for each lost run. */
std::optional<double> medianWithLost(const CellSummary& summary)
{
  std::vector<double> values = summary.values;
  values.resize(values.size() + summary.lost, kLost);
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const std::size_t upper = values.size() / 2, lower = (values.size() - 1) / 2;
  if (values[upper] == kLost) return kLost;
  return 0.5 * (values[lower] + values[upper]);
}
}  // namespace

void writeStudy(const std::filesystem::path& folder, const Study& study)
{
  writeAtomically(folder / "results.csv", [&](std::ostream& file) { writeCsv(file, study.records); });
  const nlohmann::json json{{"command", study.command}, {"machine", study.machine}, {"runs", study.records}};
  writeAtomically(folder / "results.json", [&](std::ostream& file) { file << jsonText(json, 1) << '\n'; });
}

Study readStudy(const std::filesystem::path& folder)
{
  std::ifstream file(folder / "results.json");
  if (!file)
    throw std::runtime_error(
        fmt::format("{} has no results.json: is it the folder of an experiment?", folder.string()));
  try
  {
    const auto json = nlohmann::json::parse(file);
    return {json.at("command"), json.at("machine"), json.at("runs").get<std::vector<RunRecord>>()};
  }
  catch (const nlohmann::json::exception& e)
  {
    throw std::runtime_error(fmt::format("{}: {}", (folder / "results.json").string(), reasonOf(e)));
  }
}

void pointLatestTo(const std::filesystem::path& folder)
{
  const auto target = std::filesystem::absolute(folder / "").parent_path();
  const auto link = target.parent_path() / "latest";
  std::error_code error;
  if (std::filesystem::is_symlink(link)) std::filesystem::remove(link, error);
  if (!std::filesystem::exists(link)) std::filesystem::create_directory_symlink(target.filename(), link, error);
}

std::string thisMachine()
{
  std::ifstream file("/proc/cpuinfo");
  std::string processor = "unknown processor";
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0)
    {
      processor = trimmed(std::string_view(line).substr(line.find(':') + 1));
      break;
    }
  return fmt::format("{}, {} cores", processor, std::thread::hardware_concurrency());
}

std::vector<StudyCell> cellsOf(const std::vector<RunRecord>& records)
{
  const std::set<std::string> names = varied(records);
  std::vector<StudyCell> cells;
  for (const RunRecord& record : records)
  {
    const std::string group = groupOf(record.run, names);
    auto cell = std::find_if(cells.begin(), cells.end(),
                             [&](const StudyCell& c) {
                               return c.stand == record.run.stand && c.lidars == record.run.lidars && c.group == group;
                             });
    if (cell == cells.end()) cell = cells.insert(cell, {record.run.stand, record.run.lidars, group, {}});
    cell->records.push_back(&record);
  }
  return cells;
}

std::optional<double> CellSummary::median() const
{
  const auto value = medianWithLost(*this);
  if (!value || *value == kLost) return std::nullopt;
  return value;
}

bool CellSummary::medianIsLost() const { return medianWithLost(*this) == kLost; }

CellSummary summaryOf(const StudyCell& cell, const Quantity& quantity)
{
  CellSummary summary;
  for (const RunRecord* record : cell.records)
  {
    const auto value = quantity.of(*record);
    if (!record->finished())
      ++summary.failed;
    else if (!value)
      continue;
    else if (quantity.lost == LostRuns::CountedApart && record->lost())
      ++summary.lost;
    else
      summary.values.push_back(*value);
  }
  return summary;
}
}  // namespace scanloom
