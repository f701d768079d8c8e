#include "RunReport.h"

#include "SlamOutcome.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
void RunReport::warn(const std::vector<std::string>& warnings, WarnedLine line)
{
  warnings_.insert(warnings_.end(), warnings.begin(), warnings.end());
  warnInPython(warnings, line);
}

void RunReport::end(const std::optional<SlamRunResult>& result)
{
  if (result_ || !result) return;
  result_ = withSensorsNotUsed(*result, sensors_not_used_);
  const RunSummary& summary = result_->summary;
  std::vector<std::string> last;
  for (const std::string& text : {unsoundPoses(summary), droppedScans(summary)})
    if (!text.empty()) last.push_back(text);
  if (summary.error.empty() && !isGood(*result_))
    last.push_back(fmt::format("the result is not good: {}", summary.outcome));
  warn(last);
  if (!summary.error.empty()) throw std::runtime_error(summary.error);
}

std::optional<std::string> RunReport::outcome() const
{
  return result_ ? std::optional(result_->summary.outcome) : std::nullopt;
}

std::optional<bool> RunReport::good() const { return result_ ? std::optional(isGood(*result_)) : std::nullopt; }

std::map<std::string, std::uint64_t> RunReport::counts() const
{
  return result_ ? result_->summary.counts : std::map<std::string, std::uint64_t>{};
}
}  // namespace scanloom
