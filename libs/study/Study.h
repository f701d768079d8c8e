/** The results of a sweep as they lie in its folder, and as cells of a diagram. */
#pragma once
#include "study/RunRecord.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct Study
{
  std::string command;  // that repeats it
  std::string machine;  // processor and number of cores
  std::vector<RunRecord> records;
};

/** results.json and results.csv. Throws std::runtime_error if they cannot be written. */
void writeStudy(const std::filesystem::path& folder, const Study&);

/** Throws std::runtime_error if there is none in the folder. */
Study readStudy(const std::filesystem::path& folder);

/** `AMD EPYC 7B13, 2 cores` */
std::string thisMachine();

/** All seeds of one combination. */
struct StudyCell
{
  std::string stand, lidars;
  std::string group;  // `N = 5`, and the settings that vary
  std::vector<const RunRecord*> records;
};

/** In the order in which they first occur. The records must outlive the cells. */
std::vector<StudyCell> cellsOf(const std::vector<RunRecord>&);

enum class LostRuns
{
  Apart,      // their errors say nothing but that they are lost
  LikeOthers  // they cost as much
};

/** What is told of each run; nothing if it failed. */
struct Quantity
{
  std::string name;  // "drift [m]"
  std::function<std::optional<double>(const RunRecord&)> of;
  LostRuns lost = LostRuns::Apart;
};

struct CellSummary
{
  std::vector<double> values;  // of the runs that are not lost
  std::size_t lost = 0, untold = 0;

  /** Lost runs count as worse than all others; nothing if the median itself is lost, or if there is no run. */
  std::optional<double> median() const;
  bool medianIsLost() const;
};
CellSummary summaryOf(const StudyCell&, const Quantity&);
}  // namespace scanloom
