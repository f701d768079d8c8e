/** `scanloom register`: the pose of one point cloud in another. */
#include "Arguments.h"
#include "CloudRegistration.h"
#include "RegistrationReport.h"
#include "Settings.h"
#include "Verb.h"
#include "cloud/CloudFile.h"
#include "source/Extrinsics.h"

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
  ConfigurationArguments configuration;
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
  if (!file || file >> more) throw std::runtime_error(fmt::format("{}: is no 4x4 matrix of 16 numbers", path.string()));
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
    throw UsageError(fmt::format("--truth '{}': is no file, and as a pose: {}", text, problem.what()));
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
  const Loaded<RegisterSettings> loaded = load<RegisterSettings>(arguments.configuration);
  const LevelSizes levels = levelsOf(loaded.settings, loaded.configuration);
  const Rigid guess = poseOf("--guess", arguments.guess);
  const std::optional<Rigid> truth = truthOf(arguments.truth);
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }

  const CloudFile target = readCloud(arguments.target), source = readCloud(arguments.source);
  const CloudPair clouds(target.points, source.points, levels, loaded.settings);
  if (truth && arguments.trials.trials > 0) return reportTrials(arguments, clouds, *truth);

  RegistrationReport report;
  report.points = {target.points.size(), target.dropped, source.points.size(), source.dropped};
  report.target_milliseconds = clouds.targetMilliseconds();
  report.source_milliseconds = clouds.sourceMilliseconds();
  report.registration = clouds.registered(guessOf(guess, arguments));
  if (truth) report.error = poseError(report.registration.result.target_T_source, *truth);
  std::cout << (arguments.json ? toJson(report) : toText(report)) << '\n';
  return report.registration.result.trustworthy() ? kDone : kQualityGate;
}

void addTrials(CLI::App& app, RegisterArguments& arguments, CLI::Option* truth, CLI::Option* guess)
{
  TrialOptions& options = arguments.trials;
  options.trials = 0;
  CLI::Option* trials = app.add_option("--trials", options.trials,
                                       "registers so often, from guesses about the truth, and reports how well")
                            ->check(CLI::Range(1, 1000000))
                            ->needs(truth)
                            ->excludes(guess);
  app.add_option("--spread-m", options.spread, "how far each trial's guess is off, in a random direction")
      ->check(CLI::NonNegativeNumber)
      ->needs(trials);
  CLI::Option* any_axis =
      app.add_option("--spread-deg", options.spread_deg, "how far it is turned, about a random axis")
          ->check(CLI::Range(0.0, 180.0))
          ->needs(trials);
  app.add_option("--spread-yaw-deg", arguments.spread_yaw_deg, "the same about z only, either way")
      ->check(CLI::Range(0.0, 180.0))
      ->needs(trials)
      ->excludes(any_axis);
  addSeed(app, options.seed)->needs(trials);
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<RegisterArguments>();
  app.add_option("TARGET", arguments->target, "the cloud that stays: .ply, .pcd, .bin (KITTI), each also .gz")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("SOURCE", arguments->source, "the cloud whose pose in the target is sought")
      ->required()
      ->check(CLI::ExistingFile);
  CLI::Option* guess =
      app.add_option("--guess", arguments->guess, "target_T_source to start from: \"x y z yaw pitch roll\" in m, deg")
          ->type_name("POSE")
          ->capture_default_str();
  CLI::Option* sigma = app.add_option("--guess-sigma-m", arguments->guess_sigma,
                                      "its standard deviation: chooses the levels and holds what the clouds leave open")
                           ->check(CLI::PositiveNumber);
  sigma->needs(app.add_option("--guess-sigma-deg", arguments->guess_sigma_deg, "that of its angles")
                   ->check(CLI::PositiveNumber)
                   ->needs(sigma));
  CLI::Option* truth = app.add_option("--truth", arguments->truth,
                                      "the true target_T_source, or a file of its 4x4 matrix: reports errors")
                           ->type_name("POSE|FILE");
  addTrials(app, *arguments, truth, guess);
  addConfiguration(app, arguments->configuration);
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb registerVerb()
{
  return {"register", "the pose of one point cloud in another", schemaOf<RegisterSettings>(), &addOptions};
}
}  // namespace scanloom
