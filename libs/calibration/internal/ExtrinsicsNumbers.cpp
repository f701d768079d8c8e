#include "calibration/internal/ExtrinsicsNumbers.h"

#include "base/core/Angle.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace scanloom
{
namespace
{
constexpr const char* kNumbers[] = {"x",        "y", "z", "the turn about x", "the turn about y", "the turn about z",
                                    "the clock"};

/** The numbers that make up most of the direction: "y, the turn about z". */
std::string namesOf(const OpenDirection& open)
{
  constexpr double kLeast = 0.3;
  std::string names;
  for (int i = 0; i < 7; ++i)
    if (std::abs(open.direction[i]) > kLeast) names += (names.empty() ? "" : ", ") + std::string(kNumbers[i]);
  return names;
}
}  // namespace

Vector7d deviationsOf(const Matrix7d& covariance)
{
  Vector7d sigma = covariance.diagonal().cwiseSqrt();
  sigma.segment<3>(3) /= kDegree;
  return sigma;
}

std::string poseInWords(const Extrinsics& extrinsics, const Matrix7d& covariance)
{
  const Eigen::Vector3d p = extrinsics.body_T_sensor.translation, a = extrinsics.body_T_sensor.yawPitchRoll() / kDegree;
  const Vector7d sigma = deviationsOf(covariance);
  return fmt::format(
      "x y z {:.4f} {:.4f} {:.4f} m (+- {:.4f} {:.4f} {:.4f}), yaw pitch roll {:.3f} {:.3f} {:.3f} deg (+- {:.3f} "
      "{:.3f} {:.3f} about z y x)",
      p.x(), p.y(), p.z(), sigma[0], sigma[1], sigma[2], a[0], a[1], a[2], sigma[5], sigma[4], sigma[3]);
}

std::string openInWords(const std::string& sensor, const std::vector<OpenDirection>& open)
{
  std::string words;
  for (const OpenDirection& o : open)
    words += fmt::format("{}: OPEN: {}: known only to +- {}, so the given value stays\n", sensor, namesOf(o),
                         o.isClock() ? fmt::format("{:.1f} ms", 1e3 * o.sigma) : fmt::format("{:.2f} m", o.sigma));
  return words;
}

nlohmann::json numbersOf(const Extrinsics& extrinsics, const Matrix7d& covariance,
                         const std::vector<OpenDirection>& open)
{
  const Eigen::Vector3d p = extrinsics.body_T_sensor.translation, a = extrinsics.body_T_sensor.yawPitchRoll() / kDegree;
  const Vector7d sigma = deviationsOf(covariance);
  nlohmann::json json{{"pose", {p.x(), p.y(), p.z(), a[0], a[1], a[2]}},
                      {"clock_offset", extrinsics.clock_offset},
                      {"open", nlohmann::json::array()}};
  json["sigma"] = std::vector<double>(sigma.data(), sigma.data() + 7);
  for (int i = 0; i < 7; ++i)
    for (int k = 0; k < 7; ++k) json["covariance"][static_cast<std::size_t>(i)].push_back(covariance(i, k));
  for (const OpenDirection& o : open) json["open"].push_back({{"numbers", namesOf(o)}, {"sigma", o.sigma}});
  return json;
}
}  // namespace scanloom
