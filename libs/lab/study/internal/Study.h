/** The results of a sweep: the files in its folder, and the cells of its diagrams. */
#pragma once
#include "lab/study/internal/RunRecord.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct Study
{
  std::string command;  // repeats the sweep
  std::string machine;  // processor and number of cores
  std::vector<RunRecord> records;
};

/** results.json and results.csv. Throws std::runtime_error if they cannot be written. */
void writeStudy(const std::filesystem::path& folder, const Study&);

/** Reads results.json. Throws std::runtime_error if the folder has none. */
Study readStudy(const std::filesystem::path& folder);

/** Sets the link `latest` in the parent folder, so that scripts find the newest results. */
void pointLatestTo(const std::filesystem::path& folder);

/** `AMD EPYC 7B13, 2 cores` */
std::string thisMachine();

/** The runs of one combination, with all of its seeds. */
struct StudyCell
{
  std::string stand, lidars;
  std::string group;  // `N = 5`, and those settings that differ between runs
  std::vector<const RunRecord*> records;
};

/** In the order of their first records. The records must outlive the cells. */
std::vector<StudyCell> cellsOf(const std::vector<RunRecord>&);

enum class LostRuns
{
  CountedApart,  // for errors: the value of a lost run means nothing
  LikeOthers     // for costs: a lost run costs as much as any other
};

/** A number of each run; none if the run failed, or does not have it: an error without a reference. */
struct Quantity
{
  std::string name;  // "drift [m]"
  std::function<std::optional<double>(const RunRecord&)> of;
  LostRuns lost = LostRuns::CountedApart;
};

struct CellSummary
{
  std::vector<double> values;  // without the runs counted as lost
  std::size_t lost = 0, failed = 0;

  bool empty() const { return values.empty() && lost == 0; }

  /** Lost runs count as larger than all others. None if the median itself is a lost run, or if there is no run. */
  std::optional<double> median() const;
  bool medianIsLost() const;
};
CellSummary summaryOf(const StudyCell&, const Quantity&);
}  // namespace scanloom
