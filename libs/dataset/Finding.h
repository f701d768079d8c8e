/** What a doctor says: one line each, with the verdict and the way to mend it. */
#pragma once
#include <string>
#include <vector>

namespace scanloom
{
enum class Verdict
{
  NotMeasured,
  Ok,
  Warning,
  NotFit,
};
std::string toString(Verdict);

struct Finding
{
  std::string about;    // a lidar's name, "imu", "rig"
  std::string measure;  // "loss"
  Verdict verdict = Verdict::Ok;
  std::string says;  // the figures, with units
  std::string mend;  // one sentence; empty if there is nothing to mend
};
using Findings = std::vector<Finding>;

/** Verdict::Ok at least. */
Verdict worstOf(const Findings&);

/** "fit for SLAM, 2 warnings": one line. */
std::string summaryOf(const Findings&);

/** A table of at most `width` columns, grouped by what the findings are about. */
std::string toText(const Findings&, std::size_t width = 100);
}  // namespace scanloom
