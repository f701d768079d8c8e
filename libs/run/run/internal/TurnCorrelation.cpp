#include "run/run/internal/TurnCorrelation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace scanloom
{
namespace
{
constexpr Duration kTurnWindow = 100ms;
constexpr std::size_t kFewestWindows = 10;
constexpr double kLeastRate = 0.005;  // rad/s, root mean square: above the noise of the gyroscopes in lidars

/** Rates in the body's frame, by the number of the window. */
std::map<std::int64_t, Eigen::Vector3d> meanRates(const PlacedGyro& gyro)
{
  std::map<std::int64_t, std::pair<Eigen::Vector3d, double>> sums;
  for (const ImuSample& sample : gyro.samples)
  {
    const auto place =
        sums.try_emplace(sample.stamp.time_since_epoch() / kTurnWindow, Eigen::Vector3d(0, 0, 0), 0).first;
    place->second.first += sample.gyro;
    place->second.second += 1;
  }
  std::map<std::int64_t, Eigen::Vector3d> means;
  for (const auto& [window, sum] : sums) means[window] = gyro.body_T_imu.rotation * (sum.first / sum.second);
  return means;
}

Eigen::Matrix3Xd deviationsOf(const std::vector<Eigen::Vector3d>& rates)
{
  Eigen::Matrix3Xd columns(3, static_cast<Eigen::Index>(rates.size()));
  for (std::size_t i = 0; i < rates.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = rates[i];
  columns.colwise() -= columns.rowwise().mean().eval();
  return columns;
}
}  // namespace

std::optional<double> turnCorrelation(const PlacedGyro& a, const PlacedGyro& b)
{
  const std::map<std::int64_t, Eigen::Vector3d> means_of_b = meanRates(b);
  std::vector<Eigen::Vector3d> rates_a, rates_b;
  for (const auto& [window, rate] : meanRates(a))
  {
    const auto same = means_of_b.find(window);
    if (same == means_of_b.end()) continue;
    rates_a.push_back(rate);
    rates_b.push_back(same->second);
  }
  if (rates_a.size() < kFewestWindows) return std::nullopt;
  const Eigen::Matrix3Xd of_a = deviationsOf(rates_a), of_b = deviationsOf(rates_b);
  const double least = kLeastRate * std::sqrt(static_cast<double>(rates_a.size()));
  if (of_a.norm() < least || of_b.norm() < least) return std::nullopt;
  return of_a.cwiseProduct(of_b).sum() / (of_a.norm() * of_b.norm());
}
}  // namespace scanloom
