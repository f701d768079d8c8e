#include "lab/study/internal/ExperimentRun.h"

#include "base/core/Interruption.h"
#include "base/core/OutputFile.h"
#include "base/core/jsonText.h"
#include "base/formats/Trajectory.h"
#include "lab/evaluation/Evaluation.h"
#include "lab/study/RunReference.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <fstream>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr const char* kRecord = "record.json";
constexpr std::size_t kHashDigits = 8;

struct PoseErrorsOfRun
{
  PoseErrors absolute, relative;
};

/** With _ for characters that are awkward in a file name. */
std::string fileName(std::string label)
{
  std::replace_if(
      label.begin(), label.end(),
      [](unsigned char c) { return !std::isalnum(c) && c != '+' && c != '-' && c != '.' && c != '='; }, '_');
  return label;
}

nlohmann::json readJson(const std::filesystem::path& path)
{
  std::ifstream file(path);
  if (!file) throw std::runtime_error(fmt::format("{} is missing", path.string()));
  return nlohmann::json::parse(file);
}

/** With positions and poses the drift is that of the prism, and APE and RPE are those of the body. */
PoseErrorsOfRun poseErrorsOf(const Evaluation& evaluation, const EvaluationInput& input,
                             const EvaluationOptions& options)
{
  if (!input.truth) return {evaluation.absolute, evaluation.relative};
  const std::vector<PosePair> poses = posePairs(input.scans, Eigen::Vector3d::Zero(), *input.truth);
  return {absoluteErrors(poses, options.alignment), relativeErrors(poses)};
}

RunFigures figuresOf(const std::filesystem::path& out, const RunReference& reference)
{
  EvaluationInput input;
  input.scans = readTum(out / "trajectory.tum");
  Trajectory imu_rate = readTum(out / "trajectory_imu.tum");
  if (!imu_rate.empty()) input.imu_rate = std::move(imu_rate);
  if (reference.station)
    input.reference = *reference.station;
  else
    input.reference = *reference.poses;
  input.truth = reference.poses;
  EvaluationOptions options;
  options.body_p_point = reference.body_p_point;
  const Evaluation e = evaluate(input, options);
  const auto [ape, rpe] = poseErrorsOf(e, input, options);

  RunFigures figures;
  figures.drift = e.drift.largest;
  figures.path = e.drift.path_length;
  figures.final = e.drift.final;
  figures.samples = e.drift.samples;
  figures.drift_percent = e.drift.percent();
  if (e.imu_rate_drift) figures.imu_rate_drift = e.imu_rate_drift->largest;
  if (e.floor) figures.floor = e.floor->largest;
  figures.ape = ape.metres.rmse;
  if (rpe.compared > 0)
  {
    figures.rpe = rpe.metres.rmse;
    if (rpe.degrees) figures.rpe_deg = rpe.degrees->rmse;
  }
  figures.over_distance = (e.imu_rate_drift ? *e.imu_rate_drift : e.drift).over_distance;
  return figures;
}

std::optional<double> okPercent(const nlohmann::json& summary)
{
  const auto count = [&](const char* name) { return summary.at("counts").at(name).get<double>(); };
  const double poses = count("poses");
  if (poses == 0) return std::nullopt;
  return 100 * (poses - count("poses_initialising") - count("poses_degenerate") - count("poses_lost")) / poses;
}

RunCosts costsOf(const nlohmann::json& summary)
{
  RunCosts costs;
  for (const auto& [stage, time] : summary.at("stages").items()) costs.stage_ms[stage] = time.at("mean_ms");
  costs.real_time_factor = summary.at("real_time_factor");
  costs.peak_memory_mb = 1e-6 * summary.at("peak_memory_bytes").get<double>();
  return costs;
}

void runAndEvaluate(RunRecord& record, const ExperimentFolder& folder, const DriveFolder& drive,
                    const std::filesystem::path& out)
{
  std::filesystem::remove_all(out);  // results of a failed or interrupted run
  std::filesystem::create_directories(out);
  if (!drive.error.empty()) throw std::runtime_error(drive.error);

  const auto start = std::chrono::steady_clock::now();
  runVerb(slamCommand(record.run, folder, drive.path, out), out / "log.txt");
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  const nlohmann::json summary = readJson(out / "summary.json");
  record.outcome = summary.at("outcome");
  record.costs = costsOf(summary);
  record.costs->elapsed = elapsed.count();
  record.marks.clear();
  for (const nlohmann::json& mark : summary.at("marks")) record.marks.push_back({mark.at("after_s"), mark.at("text")});
  record.ok_percent = okPercent(summary);
  if (!record.ok_percent) throw std::runtime_error("slam gave no pose: see its log.txt");
  const RunReference reference = referenceOf(drive.path, record.run.reference);
  record.reference = reference.description;
  if (reference.exists()) record.figures = figuresOf(out, reference);
}
}  // namespace

std::filesystem::path ExperimentFolder::of(const RunRecord& record) const
{
  return root / "runs" /
         fmt::format("{}_{}", fileName(record.run.label()), record.configuration_hash.substr(0, kHashDigits));
}

std::filesystem::path ExperimentFolder::of(const PlannedDrive& drive) const
{
  if (!drive.simulated()) return drive.recording;
  return root / "drives" / fmt::format("{}_{}", fileName(drive.label()), drive.hash.substr(0, kHashDigits));
}

Command slamCommand(const PlannedRun& run, const ExperimentFolder& folder, const std::filesystem::path& drive,
                    const std::filesystem::path& out)
{
  std::vector<std::string> words{ownExecutable(), "slam"};
  for (const auto& file : folder.configurations) words.insert(words.end(), {"-c", file});
  if (!run.simulation.empty()) words.insert(words.end(), {"-c", run.simulation});  // it may have sections of slam
  if (run.lidars != kAllLidars) words.insert(words.end(), {"--lidars", run.lidars});
  words.insert(words.end(), {"--every-nth", std::to_string(run.every_nth)});
  const auto settings = settingsOfSlam(run);
  addSettings(words, settings);
  const bool maps_are_set =
      std::any_of(settings.begin(), settings.end(), [](const auto& setting) { return setting.first == "output.maps"; });
  if (!folder.keep_maps && !maps_are_set) words.insert(words.end(), {"--set", "output.maps=false"});
  words.insert(words.end(), {"-w", "--out-dir", out});
  // In an INI file a relative path starts at the file's folder, not at this program's.
  const std::string recording = std::filesystem::absolute(drive).string();
  if (findTheDrive(folder.configurations)) return {words, {"SCANLOOM_RECORDING=" + recording}};
  words.push_back(recording);
  return {words, {}};
}

RunRecord execute(RunRecord record, const ExperimentFolder& folder, const DriveFolder& drive)
{
  const auto out = folder.of(record);
  try
  {
    runAndEvaluate(record, folder, drive, out);
  }
  catch (const std::exception& e)
  {
    record.outcome = "FAILED";
    record.error = e.what();
  }
  if (interrupted()) return record;
  writeAtomically(out / kRecord, [&](std::ostream& file) { file << jsonText(record) << '\n'; });
  return record;
}

void removeRecord(const RunRecord& planned, const ExperimentFolder& folder)
{
  std::filesystem::remove(folder.of(planned) / kRecord);
}

std::optional<RunRecord> recordOf(const RunRecord& planned, const ExperimentFolder& folder)
{
  const auto path = folder.of(planned) / kRecord;
  if (!std::filesystem::exists(path)) return std::nullopt;
  auto record = readJson(path).get<RunRecord>();
  if (record.configuration_hash != planned.configuration_hash) return std::nullopt;
  return record;
}

FinishedRuns finishedBefore(const std::vector<RunRecord>& planned, const ExperimentFolder& folder)
{
  FinishedRuns finished;
  for (const RunRecord& run : planned)
  {
    finished.push_back(recordOf(run, folder));
    if (finished.back() && !finished.back()->finished()) finished.back().reset();
  }
  return finished;
}
}  // namespace scanloom
