/** `scanloom register`: finds the pose of one point cloud in another. */
#include "Arguments.h"
#include "Verb.h"
#include "base/formats/CloudFile.h"
#include "input/rig/Extrinsics.h"
#include "lab/evaluation/CloudRegistration.h"
#include "lab/evaluation/RegistrationReport.h"

#include <fmt/format.h>

#include <fstream>
#include <iostream>
#include <memory>
#include <optional>

namespace scanloom
{
namespace
{
struct RegisterArguments
{
  std::filesystem::path target, source;
  std::string guess = "0 0 0 0 0 0";
  std::string truth;  // empty: not known
  TrialOptions trials;
  std::optional<double> spread_yaw_deg;
  std::optional<double> guess_sigma, guess_sigma_deg;
  bool json = false;
};

Rigid poseOf(const std::string& option, const std::string& text)
try
{
  return parsePose(text);
}
catch (const std::invalid_argument& problem)
{
  throw UsageError(fmt::format("{} '{}': {}", option, text, problem.what()));
}

Rigid readMatrix(const std::filesystem::path& path)
{
  std::ifstream file(path);
  Eigen::Matrix4d matrix;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) file >> matrix(i / 4, i % 4);
  std::string more;
  if (!file || file >> more)
    throw std::runtime_error(fmt::format("{}: must have the 16 numbers of a 4x4 matrix", path.string()));
  try
  {
    return Rigid::fromMatrix(matrix);
  }
  catch (const std::invalid_argument& problem)
  {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), problem.what()));
  }
}

std::optional<Rigid> truthOf(const std::string& text)
{
  if (text.empty()) return std::nullopt;
  if (std::filesystem::is_regular_file(text)) return readMatrix(text);
  try
  {
    return parsePose(text);
  }
  catch (const std::invalid_argument& problem)
  {
    throw UsageError(fmt::format("--truth '{}': neither a file nor a pose: {}", text, problem.what()));
  }
}

TrialOptions trialsOf(const RegisterArguments& arguments)
{
  TrialOptions trials = arguments.trials;
  if (!arguments.spread_yaw_deg) return trials;
  trials.spread_deg = *arguments.spread_yaw_deg;
  trials.axis = SpreadAxis::Vertical;
  return trials;
}

PoseGuess guessOf(const Rigid& pose, const RegisterArguments& arguments)
{
  if (!arguments.guess_sigma) return pose;
  const double metres = *arguments.guess_sigma, radians = *arguments.guess_sigma_deg * M_PI / 180;
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(metres * metres), Eigen::Vector3d::Constant(radians * radians);
  return {pose, variances.asDiagonal()};
}

int reportTrials(const RegisterArguments& arguments, const CloudPair& clouds, const Rigid& truth)
{
  const TrialsReport report = tryRegistration(
      truth, trialsOf(arguments), [&](const Rigid& guess) { return clouds.registered(guessOf(guess, arguments)); });
  std::cout << (arguments.json ? toJson(report) : toText(report)) << '\n';
  return kDone;
}

int run(const RegisterArguments& arguments)
{
  const Rigid guess = poseOf("--guess", arguments.guess);
  const std::optional<Rigid> truth = truthOf(arguments.truth);
  const CloudFile target = readCloud(arguments.target), source = readCloud(arguments.source);
  const CloudPair clouds(target.points, source.points);
  if (truth && arguments.trials.trials > 0) return reportTrials(arguments, clouds, *truth);

  RegistrationReport report;
  report.points = {target.points.size(), target.dropped, source.points.size(), source.dropped};
  report.target_milliseconds = clouds.targetMilliseconds();
  report.source_milliseconds = clouds.sourceMilliseconds();
  report.registration = clouds.registered(guessOf(guess, arguments));
  if (!arguments.guess_sigma) report.contradiction = clouds.contradiction(report.registration.result, guess);
  if (truth) report.error = poseError(report.registration.result.target_T_source, *truth);
  std::cout << (arguments.json ? toJson(report) : toText(report)) << '\n';
  return report.trustworthy() ? kDone : kQualityGate;
}

void addTrials(CLI::App& app, RegisterArguments& arguments, const Option& truth, const Option& guess)
{
  TrialOptions& options = arguments.trials;
  options.trials = 0;
  const Option trials =
      addOption(app, "--trials", options.trials,
                "register this many times, from guesses around --truth, and report success, errors and time")
          .between(1, 1000000)
          .needs(truth)
          .excludes(guess);
  addOption(app, "--spread-m", options.spread,
            "trials: distance of each guess from the true position, in m, in a random direction")
      .notNegative()
      .needs(trials);
  const Option any_axis = addOption(app, "--spread-deg", options.spread_deg,
                                    "trials: rotation of each guess from the true one, in deg, about a random axis")
                              .between(0.0, 180.0)
                              .needs(trials);
  addOption(app, "--spread-yaw-deg", arguments.spread_yaw_deg,
            "trials: rotation of each guess from the true one, in deg, about z with a random sign")
      .between(0.0, 180.0)
      .needs(trials)
      .excludes(any_axis);
  addSeed(app, options.seed).needs(trials);
}

std::function<int()> addRegisterOptions(CLI::App& app)
{
  auto arguments = std::make_shared<RegisterArguments>();
  addOption(app, "TARGET", arguments->target,
            "point cloud that defines the frame: .ply, .pcd or .bin (KITTI), each also as .gz")
      .required()
      .existingFile();
  addOption(app, "SOURCE", arguments->source, "point cloud whose pose in TARGET is computed").required().existingFile();
  const Option guess = addOption(app, "--guess", arguments->guess,
                                 "initial guess of target_T_source: \"x y z yaw pitch roll\" in m and deg")
                           .typeName("POSE")
                           .showDefault();
  const Option sigma =
      addOption(app, "--guess-sigma-m", arguments->guess_sigma,
                "standard deviation of the guess's position, in m; it chooses the cell sizes, and directions that the "
                "clouds leave open stay as guessed")
          .positive();
  sigma.needs(addOption(app, "--guess-sigma-deg", arguments->guess_sigma_deg,
                        "standard deviation of the guess's angles, in deg")
                  .positive()
                  .needs(sigma));
  const Option truth = addOption(app, "--truth", arguments->truth,
                                 "the true target_T_source, or a file with its 4x4 matrix: errors are reported")
                           .typeName("POSE|FILE");
  addTrials(app, *arguments, truth, guess);
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb registerVerb()
{
  return {"register", "pose of one point cloud in another, by registration", {}, &addRegisterOptions};
}
}  // namespace scanloom
