#include "output/RunSummary.h"

#include <sys/resource.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace scanloom
{
void StageTime::add(double duration)
{
  ++calls;
  total += duration;
  longest = std::max(longest, duration);
}

std::uint64_t peakMemory()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

void to_json(nlohmann::json& json, const StageTime& stage)
{
  const double calls = static_cast<double>(std::max<std::uint64_t>(stage.calls, 1));
  json = {{"calls", stage.calls},
          {"total_ms", 1e3 * stage.total},
          {"mean_ms", 1e3 * stage.total / calls},
          {"max_ms", 1e3 * stage.longest}};
}

void to_json(nlohmann::json& json, const RunSummary& run)
{
  json = {{"command", run.command},
          {"outcome", run.outcome},
          {"versions", run.versions},
          {"seed", run.seed},
          {"counts", run.counts},
          {"stages", run.stages},
          {"recorded_s", run.recorded},
          {"elapsed_s", run.elapsed},
          {"real_time_factor", run.realTimeFactor()},
          {"path_length_m", run.path_length},
          {"peak_memory_bytes", run.peak_memory}};
}

void writeSummary(const std::filesystem::path& path, const RunSummary& run)
{
  OutputFile file(path);
  file.stream() << nlohmann::json(run).dump(2) << '\n';
  file.commit();
}
}  // namespace scanloom
