/** `scanloom evaluate`: compares a trajectory with a total station or with true poses. */
#include "Arguments.h"
#include "Verb.h"
#include "evaluation/Evaluation.h"
#include "evaluation/EvaluationReport.h"
#include "evaluation/PositionError.h"
#include "formats/TrajectoryReader.h"
#include "rig/Extrinsics.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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
  throw UsageError(fmt::format("--lever-arm '{}': must be \"x y z\" in m", text));
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
  fmt::print(stderr, "drift {:.3f} m is above the limit of {} m\n", drift, limit);
  return kQualityGate;
}

int compareFromFirstPose(const EvaluateArguments& arguments)
{
  if (isTotalStation(arguments.reference))
    throw UsageError(
        "--align first needs a reference with rotations, which a total station does not have; use yaw or se3");
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
  addOption(app, "--rpe-delta", arguments.delta.delta, "distance between the two poses of a pair of the RPE")
      .positive()
      .showDefault();
  const std::vector<std::pair<std::string, DeltaUnit>> units{{"m", DeltaUnit::Metres}, {"f", DeltaUnit::Frames}};
  addChoice(app, "--rpe-unit", arguments.delta.unit, units,
            "unit of --rpe-delta: m along the estimate, or f for frames [m]")
      .typeName("m|f");
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
            "positions of a total station (.csv), or poses: TUM, EuRoC or KITTI")
      .required()
      .typeName("FILE");
  addOption(app, "--truth", arguments->truth,
            "true poses, TUM: to report the error of the interpolation between scans alone [the reference, if it has "
            "poses]")
      .typeName("FILE");
  addComparison(app, *arguments);
  addOption(app, "--fail-if-drift-above", arguments->drift_limit,
            "end with status 3 if the drift is larger than this, in m")
      .notNegative()
      .typeName("M");
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
