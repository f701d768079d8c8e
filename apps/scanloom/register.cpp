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
#include <sstream>

namespace scanloom
{
namespace
{
struct RegisterArguments
{
  std::filesystem::path target, source;
  std::string guess = "0 0 0 0 0 0";
  std::string truth;        // empty: not known
  std::string guess_sigma;  // empty: not known
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

PoseGuess guessOf(const Rigid& pose, const std::string& sigma)
{
  if (sigma.empty()) return pose;
  std::istringstream numbers(sigma);
  double metres = 0, degrees = 0;
  std::string more;
  if (!(numbers >> metres >> degrees) || numbers >> more || !(metres > 0) || !(degrees > 0))
    throw UsageError(fmt::format("--guess-sigma '{}': must be \"M DEG\", both above 0", sigma));
  return guessWithin(pose, {metres, degrees});
}

int run(const RegisterArguments& arguments)
{
  const Rigid pose = poseOf("--guess", arguments.guess);
  const PoseGuess guess = guessOf(pose, arguments.guess_sigma);
  const std::optional<Rigid> truth = truthOf(arguments.truth);
  const CloudFile target = readCloud(arguments.target), source = readCloud(arguments.source);
  RegistrationReport report = registrationReport(target.points, source.points, guess);
  report.points.target_dropped = target.dropped;
  report.points.source_dropped = source.dropped;
  if (truth) report.error = poseError(report.registration.result.target_T_source, *truth);
  std::cout << (arguments.json ? toJson(report) : toText(report)) << '\n';
  return report.trustworthy() ? kDone : kQualityGate;
}

std::function<int()> addRegisterOptions(CLI::App& app)
{
  auto arguments = std::make_shared<RegisterArguments>();
  addOption(app, "TARGET", arguments->target,
            "point cloud that defines the frame: .ply, .pcd or .bin (KITTI), each also as .gz")
      .required()
      .existingFile();
  addOption(app, "SOURCE", arguments->source, "point cloud whose pose in TARGET is computed").required().existingFile();
  addOption(app, "--guess", arguments->guess, "initial guess of target_T_source: \"x y z yaw pitch roll\" in m and deg")
      .typeName("POSE")
      .showDefault();
  addOption(
      app, "--guess-sigma", arguments->guess_sigma,
      "standard deviations of the guess: position in m, angles in deg; they choose the cell sizes, and directions "
      "that the clouds leave open stay as guessed")
      .typeName("\"M DEG\"");
  addOption(app, "--truth", arguments->truth,
            "the true target_T_source, or a file with its 4x4 matrix: errors are reported")
      .typeName("POSE|FILE");
  addJson(app, arguments->json);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb registerVerb()
{
  return {"register", "pose of one point cloud in another, by registration", {}, &addRegisterOptions};
}
}  // namespace scanloom
