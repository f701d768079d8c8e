/** `scanloom evaluate`: compares a trajectory with a total station or with true poses. */
#include "Arguments.h"
#include "Reference.h"
#include "Verb.h"
#include "base/core/OutputFile.h"
#include "base/core/jsonText.h"
#include "base/formats/TrajectoryReader.h"
#include "input/rig/Extrinsics.h"
#include "lab/evaluation/Evaluation.h"
#include "lab/evaluation/EvaluationFigure.h"
#include "lab/evaluation/EvaluationReport.h"
#include "lab/evaluation/PositionError.h"
#include "lab/study/Gnuplot.h"
#include "warn.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>
#include <limits>
#include <memory>

namespace scanloom
{
namespace
{
enum class Align
{
  First,
  Yaw,
  Se3
};

struct EvaluateArguments
{
  std::filesystem::path trajectory, imu_trajectory, reference, truth;
  std::string reference_topic;
  std::string lever_arm = "0 0 0";
  Align align = Align::Yaw;
  bool apply_clock_offset = false;
  double drift_limit = std::numeric_limits<double>::infinity();  // m
  std::filesystem::path plot;
  bool json = false, overwrite = false;
};

std::optional<Trajectory> readIfGiven(const std::filesystem::path& path)
{
  if (path.empty()) return std::nullopt;
  return readTrajectory(path, &warn);
}

template <typename Result>
void print(const Result& result, bool json)
{
  if (json)
    std::cout << jsonText(toJson(result)) << '\n';
  else
    std::cout << toText(result);
}

/** `covered`: share of the reference's time with poses; the error of a few poses says nothing about the whole drive. */
int judge(double drift, double covered, const EvaluateArguments& arguments)
{
  constexpr double kLeastCoverage = 90;  // %
  const bool drifted = !(drift <= arguments.drift_limit);
  const bool is_part = std::isfinite(arguments.drift_limit) && 100 * covered < kLeastCoverage;
  if (drifted) fmt::print(stderr, "drift {:.3f} m is above the limit of {} m\n", drift, arguments.drift_limit);
  if (is_part)
    fmt::print(stderr, "the trajectory covers {:.1f} % of the reference's time, less than {} %\n", 100 * covered,
               kLeastCoverage);
  return drifted || is_part ? kQualityGate : kDone;
}

int compareFromFirstPose(const EvaluateArguments& arguments)
{
  if (!arguments.plot.empty()) throw UsageError("--plot draws what --align yaw and se3 compare, not first");
  const auto reference = readReference(arguments.reference, arguments.reference_topic, &warn);
  if (!std::holds_alternative<Trajectory>(reference))
    throw UsageError("--align first needs a reference with rotations, which points do not have; use yaw or se3");
  const PositionError error =
      positionErrorFromFirstPose(readTrajectory(arguments.trajectory, &warn), std::get<Trajectory>(reference));
  print(error, arguments.json);
  return judge(error.largest, error.covered, arguments);
}

void plot(const Evaluation& evaluation, const std::filesystem::path& file)
{
  const std::filesystem::path folder = file.parent_path();
  Gnuplot(folder.empty() ? "." : folder).drawInto(file, figureScript(evaluation));
}

int run(const EvaluateArguments& arguments)
{
  if (arguments.align == Align::First) return compareFromFirstPose(arguments);

  if (!arguments.plot.empty()) refuseExisting({arguments.plot}, arguments.overwrite);
  EvaluationOptions options;
  options.body_p_point = leverArmOf(arguments.lever_arm);
  options.alignment = arguments.align == Align::Yaw ? AlignmentKind::Yaw : AlignmentKind::Se3;
  options.apply_clock_offset = arguments.apply_clock_offset;

  EvaluationInput input;
  input.scans = readTrajectory(arguments.trajectory, &warn);
  input.imu_rate = readIfGiven(arguments.imu_trajectory);
  input.truth = readIfGiven(arguments.truth);
  input.reference = readReference(arguments.reference, arguments.reference_topic, &warn);

  warnIfAny(missingLeverArm(input, options));
  const Evaluation evaluation = evaluate(input, options);
  print(evaluation, arguments.json);
  if (arguments.align == Align::Yaw) warnIfAny(tiltedReference(evaluation, input, options));
  if (!arguments.plot.empty()) plot(evaluation, arguments.plot);
  return judge(evaluation.drift.largest, evaluation.covered, arguments);
}

void addComparison(CLI::App& app, EvaluateArguments& arguments)
{
  const std::vector<std::pair<std::string, Align>> alignments{
      {"first", Align::First}, {"yaw", Align::Yaw}, {"se3", Align::Se3}};
  addChoice(app, "--align", arguments.align, alignments,
            "alignment on the first 10 % of the path: yaw and translation (yaw), or rotation and translation (se3); "
            "first: the first poses are made equal [yaw]")
      .typeName("first|yaw|se3");
  addOption(app, "--lever-arm", arguments.lever_arm,
            "point of the body that is compared, e.g. the prism: \"x y z\" in m")
      .typeName("XYZ")
      .showDefault();
  addFlag(app, "--apply-clock-offset", arguments.apply_clock_offset,
          "correct the stamps of the reference by the clock offset that is found");
}

std::function<int()> addEvaluateOptions(CLI::App& app)
{
  auto arguments = std::make_shared<EvaluateArguments>();
  addOption(app, "--trajectory", arguments->trajectory,
            "trajectory to evaluate: TUM, EuRoC (.csv) or KITTI (with times.txt in its folder)")
      .required()
      .typeName("FILE");
  addOption(app, "--imu-trajectory", arguments->imu_trajectory, "trajectory of the same run at the IMU's rate, TUM")
      .typeName("FILE");
  addOption(app, "--reference", arguments->reference,
            "positions of a total station (.csv or .tsv), or poses: TUM, EuRoC, KITTI or a bag of ROS")
      .required()
      .typeName("FILE");
  addOption(app, "--reference-topic", arguments->reference_topic,
            "bag: topic of the reference's poses (Odometry, PoseStamped, PointStamped) [the only one]")
      .typeName("TOPIC");
  addOption(app, "--truth", arguments->truth,
            "true poses (TUM), to compute the error of interpolation between scans [the reference, if it has poses]")
      .typeName("FILE");
  addComparison(app, *arguments);
  addOption(app, "--fail-if-drift-above", arguments->drift_limit,
            "end with status 3 if the drift is larger than this, in m, or if poses cover less than 90 % of the "
            "reference's time")
      .notNegative()
      .typeName("M");
  addOption(app, "--plot", arguments->plot,
            "picture of both paths from above, their heights, and the error over distance (.svg or .png)")
      .typeName("FILE");
  addOverwrite(app, arguments->overwrite);
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb evaluateVerb()
{
  return {"evaluate",
          "drift, APE and RPE of a trajectory, compared with a total station or true poses",
          {},
          &addEvaluateOptions};
}
}  // namespace scanloom
