#include "SlamOutcome.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
std::uint64_t countOf(const RunSummary& summary, const std::string& name)
{
  const auto count = summary.counts.find(name);
  return count == summary.counts.end() ? 0 : count->second;
}
}  // namespace

SlamRunResult withSensorsNotUsed(SlamRunResult result, std::size_t not_used)
{
  result.summary.counts["sensors_not_used"] = not_used;
  if (not_used == 0) return result;
  if (result.summary.outcome == "OK") result.summary.outcome = "SENSOR MISSING";
  result.passed = false;
  return result;
}

bool isGood(const SlamRunResult& result) { return result.passed && wasReadWhole(result.summary.counts); }

std::string unsoundPoses(const RunSummary& summary)
{
  const std::uint64_t initialising = countOf(summary, "poses_initialising");
  const std::uint64_t degenerate = countOf(summary, "poses_degenerate"), lost = countOf(summary, "poses_lost");
  if (initialising + degenerate + lost == 0) return "";
  return fmt::format("{} poses INITIALISING, {} DEGENERATE, {} LOST", initialising, degenerate, lost);
}

std::string droppedScans(const RunSummary& summary)
{
  const std::uint64_t dropped = countOf(summary, "scans_dropped");
  if (dropped == 0) return "";
  return fmt::format(
      "slower than real time: {} scans were dropped, {} processed; use --every-nth, fewer lidars or coarser maps",
      dropped, countOf(summary, "scans"));
}
}  // namespace scanloom
