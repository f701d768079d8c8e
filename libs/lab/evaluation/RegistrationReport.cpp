#include "lab/evaluation/RegistrationReport.h"

#include "base/core/Angle.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kSmallestNamed = 0.2;  // component of a unit vector

constexpr std::array<const char*, 6> kSteps{"x", "y", "z", "about x", "about y", "about z"};

std::string poseLine(const Rigid& pose)
{
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Vector3d angles = pose.yawPitchRoll() / kDegree;
  return fmt::format("{:.4f} {:.4f} {:.4f} m, yaw pitch roll {:.4f} {:.4f} {:.4f} deg", t.x(), t.y(), t.z(), angles[0],
                     angles[1], angles[2]);
}

/** libs/ndt gives zeros where it has no covariance; they must not be printed as certainty. */
bool hasCovariance(const RegistrationResult& result) { return !result.covariance.isZero(0); }

std::string deviationLine(const RegistrationResult& result)
{
  if (!hasCovariance(result)) return "unknown: the clouds do not overlap";
  const Vector6d deviation = result.covariance.diagonal().cwiseSqrt();
  const Eigen::Vector3d angles = deviation.tail<3>() / kDegree;
  return fmt::format("{:.4f} {:.4f} {:.4f} m, about x y z {:.4f} {:.4f} {:.4f} deg", deviation[0], deviation[1],
                     deviation[2], angles[0], angles[1], angles[2]);
}

/** "0.97 y + 0.24 about z": a direction in the tangent space of boxPlus, without small components. */
std::string directionName(const Vector6d& direction)
{
  std::string name;
  for (std::size_t i = 0; i < kSteps.size(); ++i)
  {
    const double share = direction[static_cast<Eigen::Index>(i)];
    if (std::abs(share) < kSmallestNamed) continue;
    const char* sign = share < 0 ? (name.empty() ? "-" : " - ") : (name.empty() ? "" : " + ");
    name += fmt::format("{}{:.2f} {}", sign, std::abs(share), kSteps[i]);
  }
  return name;
}

std::string outcomeLine(const RegistrationResult& result)
{
  std::string line = toString(result.outcome);
  for (const Vector6d& direction : result.degenerate_directions)
    line += fmt::format("{} {}", &direction == &result.degenerate_directions.front() ? ": not observed:" : ",",
                        directionName(direction));
  return line;
}

std::string pointsText(std::size_t points, std::size_t dropped)
{
  return dropped == 0 ? fmt::format("{}", points) : fmt::format("{} ({} not finite, dropped)", points, dropped);
}

template <typename Matrix>
nlohmann::json rowsOf(const Matrix& matrix)
{
  nlohmann::json rows = nlohmann::json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r)
  {
    nlohmann::json row = nlohmann::json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(matrix(r, c));
    rows.push_back(row);
  }
  return rows;
}

nlohmann::json poseJson(const Rigid& pose)
{
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Vector3d angles = pose.yawPitchRoll() / kDegree;
  return {{"x_m", t.x()},
          {"y_m", t.y()},
          {"z_m", t.z()},
          {"yaw_deg", angles[0]},
          {"pitch_deg", angles[1]},
          {"roll_deg", angles[2]},
          {"matrix", rowsOf(pose.matrix())}};
}

nlohmann::json directionsJson(const std::vector<Vector6d>& directions)
{
  nlohmann::json list = nlohmann::json::array();
  for (const Vector6d& direction : directions)
    list.push_back(
        {{"name", directionName(direction)}, {"step", std::vector<double>(direction.begin(), direction.end())}});
  return list;
}

}  // namespace

RegistrationReport registrationReport(const CloudPair::Points& target, const CloudPair::Points& source,
                                      const PoseGuess& guess)
{
  const CloudPair clouds(target, source);
  RegistrationReport report;
  report.points.target = target.size();
  report.points.source = source.size();
  report.target_milliseconds = clouds.targetMilliseconds();
  report.source_milliseconds = clouds.sourceMilliseconds();
  report.registration = clouds.registered(guess);
  if (!guess.covariance) report.contradiction = clouds.contradiction(report.registration.result, guess.target_T_source);
  return report;
}

std::string toText(const RegistrationReport& report)
{
  const RegistrationResult& result = report.registration.result;
  std::string text = fmt::format("target_T_source      {}\n", poseLine(result.target_T_source));
  text += fmt::format("standard deviations  {}\n", deviationLine(result));
  if (report.error)
    text += fmt::format("error                {:.4f} m, {:.4f} deg\n", report.error->metres, report.error->degrees);
  text += fmt::format("outcome              {}\n", outcomeLine(result));
  if (const auto& apart = report.contradiction)
    text += fmt::format(
        "not confirmed        another pose, {:.2f} m and {:.1f} deg away, may be the true one: give a better --guess, "
        "and how good it is (--guess-sigma)\n",
        apart->metres, apart->degrees);
  text += fmt::format("overlap              {:.1f} %\n", 100 * result.overlap);
  text += fmt::format("iterations           {}\n", result.iterations);
  text += fmt::format("points               target {}, source {}\n",
                      pointsText(report.points.target, report.points.target_dropped),
                      pointsText(report.points.source, report.points.source_dropped));
  text += fmt::format("milliseconds         target {:.1f}, source {:.1f}, alignment {:.1f}", report.target_milliseconds,
                      report.source_milliseconds, report.registration.milliseconds);
  return text;
}

std::string toJson(const RegistrationReport& report)
{
  const RegistrationResult& result = report.registration.result;
  const CloudCounts& points = report.points;
  nlohmann::json json{{"pose", poseJson(result.target_T_source)},
                      {"covariance", hasCovariance(result) ? rowsOf(result.covariance) : nlohmann::json()},
                      {"outcome", toString(result.outcome)},
                      {"degenerate_directions", directionsJson(result.degenerate_directions)},
                      {"overlap", result.overlap},
                      {"score", result.score},
                      {"iterations", result.iterations},
                      {"milliseconds",
                       {{"prepare_target", report.target_milliseconds},
                        {"prepare_source", report.source_milliseconds},
                        {"align", report.registration.milliseconds}}},
                      {"points",
                       {{"target", points.target},
                        {"target_dropped", points.target_dropped},
                        {"source", points.source},
                        {"source_dropped", points.source_dropped}}}};
  if (report.error)
  {
    json["error_m"] = report.error->metres;
    json["error_deg"] = report.error->degrees;
  }
  if (report.contradiction)
    json["contradiction"] = {{"m", report.contradiction->metres}, {"deg", report.contradiction->degrees}};
  return json.dump(2);
}

}  // namespace scanloom
