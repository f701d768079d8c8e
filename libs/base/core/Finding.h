/** Findings of `scanloom doctor` and of the checks in a run: a measure, its verdict and a remedy. */
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
  std::string says;       // the measured values with units
  std::string mend = {};  // what to do, one sentence; empty if nothing is wrong
};
using Findings = std::vector<Finding>;

/** NotFit above `not_fit`, Warning above `warning`, otherwise Ok. */
Verdict grade(double value, double warning, double not_fit);

/** The worst verdict, but at least Ok. */
Verdict worstOf(const Findings&);

/** One line: "fit for SLAM, 2 warnings". */
std::string summaryOf(const Findings&);

/** A table of at most 100 characters a line, grouped by `about`. */
std::string toText(const Findings&);
}  // namespace scanloom
