#include "run/run/internal/RunSummary.h"

#include "base/core/OutputFile.h"
#include "base/core/jsonText.h"

#include <sys/resource.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace scanloom
{
std::uint64_t peakMemory()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

void to_json(nlohmann::json& json, const StageTime& stage)
{
  const double runs = static_cast<double>(std::max<std::uint64_t>(stage.runs, 1));
  json = {{"runs", stage.runs},
          {"total_ms", stage.total_ms},
          {"mean_ms", stage.total_ms / runs},
          {"p95_ms", stage.histogram.quantile(0.95)},
          {"max_ms", stage.longest_ms}};
}

void to_json(nlohmann::json& json, const GyroAgreement& imu)
{
  json = {{"late_ms", 1e3 * seconds(imu.lag)},
          {"late_sigma_ms", 1e3 * imu.lag_sigma},
          {"turned_deg", imu.rotation.norm() * 180 / M_PI},
          {"turned_sigma_deg", imu.sigma * 180 / M_PI},
          {"scale", imu.scale}};
}

void to_json(nlohmann::json& json, const MarkedEvent& event)
{
  json = {{"stamp_ns", nanoseconds(event.mark.stamp)}, {"after_s", event.after}, {"text", event.mark.text}};
}

void to_json(nlohmann::json& json, const RunSummary& run)
{
  json = {{"command", run.command},
          {"outcome", run.outcome},
          {"versions", run.versions},
          {"seed", run.seed},
          {"counts", run.counts},
          {"stages", run.stages},
          {"marks", run.marks},
          {"recorded_s", run.recorded},
          {"elapsed_s", run.elapsed},
          {"waited_s", run.waited},
          {"real_time_factor", run.realTimeFactor()},
          {"path_length_m", run.path_length},
          {"peak_memory_bytes", run.peak_memory}};
  if (!run.error.empty()) json["error"] = run.error;
  if (run.imu) json["imu"] = *run.imu;
  for (const Finding& lidar : run.lidars)
    json["lidars"][lidar.about][lidar.measure] = {{"verdict", toString(lidar.verdict)}, {"says", lidar.says}};
}

void writeSummary(const std::filesystem::path& path, const RunSummary& run)
{
  writeAtomically(path, [&](std::ostream& file) { file << jsonText(run) << '\n'; });
}
}  // namespace scanloom
