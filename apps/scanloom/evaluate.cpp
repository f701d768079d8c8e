/** `scanloom evaluate`: a trajectory against a total station or the true poses. */
#include "Arguments.h"
#include "EvaluationReport.h"
#include "Verb.h"
#include "evaluation/Evaluation.h"
#include "evaluation/PositionError.h"
#include "output/TrajectoryReader.h"
#include "source/Extrinsics.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <iostream>
#include <limits>
#include <map>
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
  std::string lever_arm = "0 0 0";
  Align align = Align::Yaw;
  bool apply_clock_offset = false;
  RelativeDelta delta;
  double drift_limit = std::numeric_limits<double>::infinity();  // m
  bool json = false;
};

bool isTotalStation(const std::filesystem::path& reference)
{
  return reference.extension() == ".csv" && !isEuroc(reference);
}

std::optional<Trajectory> readIfGiven(const std::filesystem::path& path)
{
  if (path.empty()) return std::nullopt;
  return readTrajectory(path);
}

Eigen::Vector3d leverArmOf(const std::string& text)
try
{
  return parsePose(text + " 0 0 0").translation;
}
catch (const std::invalid_argument&)
{
  throw UsageError(fmt::format("--lever-arm '{}': expected \"x y z\" in m", text));
}

template <typename Result>
void print(const Result& result, bool json)
{
  if (json)
    std::cout << toJson(result).dump(2) << '\n';
  else
    std::cout << toText(result);
}

int judge(double drift, double limit)
{
  if (drift <= limit) return kDone;
  fmt::print(stderr, "drift {:.3f} m is above {} m\n", drift, limit);
  return kQualityGate;
}

int compareFromFirstPose(const EvaluateArguments& arguments)
{
  if (isTotalStation(arguments.reference))
    throw UsageError("--align first: a total station gives no first rotation; use yaw or se3");
  const PositionError error =
      positionErrorFromFirstPose(readTrajectory(arguments.trajectory), readTrajectory(arguments.reference));
  print(error, arguments.json);
  return judge(error.largest, arguments.drift_limit);
}

int run(const EvaluateArguments& arguments)
{
  if (arguments.align == Align::First) return compareFromFirstPose(arguments);

  EvaluationOptions options;
  options.body_p_point = leverArmOf(arguments.lever_arm);
  options.alignment = arguments.align == Align::Yaw ? AlignmentKind::Yaw : AlignmentKind::Se3;
  options.apply_clock_offset = arguments.apply_clock_offset;
  options.delta = arguments.delta;

  EvaluationInput input;
  input.scans = readTrajectory(arguments.trajectory);
  input.imu_rate = readIfGiven(arguments.imu_trajectory);
  input.truth = readIfGiven(arguments.truth);
  if (isTotalStation(arguments.reference))
    input.reference = readTotalStation(arguments.reference);
  else
    input.reference = readTrajectory(arguments.reference);

  const Evaluation evaluation = evaluate(input, options);
  print(evaluation, arguments.json);
  return judge(evaluation.drift.largest, arguments.drift_limit);
}

void addComparison(CLI::App& app, EvaluateArguments& arguments)
{
  const std::map<std::string, Align> alignments{{"first", Align::First}, {"yaw", Align::Yaw}, {"se3", Align::Se3}};
  app.add_option(
         "--align", arguments.align,
         "what is fitted to the first 10 % of the path: yaw (and translation) or se3; first: nothing, the first "
         "poses agree [yaw]")
      ->transform(CLI::CheckedTransformer(alignments).description(""))
      ->type_name("first|yaw|se3");
  app.add_option("--lever-arm", arguments.lever_arm,
                 "the point of the body that is compared, the prism: \"x y z\" in m")
      ->type_name("XYZ")
      ->capture_default_str();
  app.add_flag("--apply-clock-offset", arguments.apply_clock_offset,
               "takes the clock offset that is found off the reference's stamps");
  app.add_option("--rpe-delta", arguments.delta.delta, "between the poses of a pair of the RPE")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  const std::map<std::string, DeltaUnit> units{{"m", DeltaUnit::Metres}, {"f", DeltaUnit::Frames}};
  app.add_option("--rpe-unit", arguments.delta.unit, "of it: m along the estimate, or f for frames [m]")
      ->transform(CLI::CheckedTransformer(units).description(""))
      ->type_name("m|f");
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<EvaluateArguments>();
  app.add_option("--trajectory", arguments->trajectory,
                 "the estimate: TUM, EuRoC (.csv) or KITTI (times.txt beside it)")
      ->required()
      ->type_name("FILE");
  app.add_option("--imu-trajectory", arguments->imu_trajectory, "the same run at the IMU's rate, TUM")
      ->type_name("FILE");
  app.add_option("--reference", arguments->reference,
                 "a total station's positions (.csv), or poses: TUM, EuRoC or KITTI")
      ->required()
      ->type_name("FILE");
  app.add_option(
         "--truth", arguments->truth,
         "true poses, TUM: tells what interpolation between scans alone costs [the reference's, if it has poses]")
      ->type_name("FILE");
  addComparison(app, *arguments);
  app.add_option("--fail-if-drift-above", arguments->drift_limit, "ends with status 3 if the drift in m is larger")
      ->check(CLI::NonNegativeNumber)
      ->type_name("M");
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb evaluateVerb()
{
  return {"evaluate", "drift, APE and RPE of a trajectory against a total station or true poses", {}, &addOptions};
}
}  // namespace scanloom
