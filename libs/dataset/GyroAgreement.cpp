#include "dataset/GyroAgreement.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr Duration kStep = 10ms;  // of the lag
constexpr std::size_t kStepsPerMean = 10;
constexpr int kMostLagSteps = 50;
constexpr Eigen::Index kFewestMeans = 30;
constexpr double kWorstSigma = 5 * M_PI / 180;

/** Column k: the integral of the body's turn rate until start + k steps. */
Eigen::Matrix3Xd turnsUntil(const PlacedGyro& gyro, Timestamp start, std::size_t steps)
{
  Eigen::Matrix3Xd turns(3, static_cast<Eigen::Index>(steps));
  const auto& s = gyro.samples;
  Eigen::Vector3d turned = Eigen::Vector3d::Zero();
  std::size_t next = 1;
  for (Eigen::Index k = 0; k < turns.cols(); ++k)
  {
    const Timestamp until = start + k * kStep;
    for (; next + 1 < s.size() && s[next].stamp <= until; ++next)
      turned += 0.5 * seconds(s[next].stamp - s[next - 1].stamp) * (s[next].gyro + s[next - 1].gyro);
    turns.col(k) = turned + seconds(until - s[next - 1].stamp) * s[next].gyro;
  }
  return gyro.body_T_imu.rotation.toRotationMatrix() * turns;
}

/** Mean rates over 0.1 s, shifted by `lag` steps, without their constant part. */
Eigen::Matrix3Xd meanRates(const Eigen::Matrix3Xd& turns, int lag)
{
  const Eigen::Index first = kMostLagSteps + lag, per = kStepsPerMean;
  const Eigen::Index n = (turns.cols() - 2 * kMostLagSteps) / per - 1;
  Eigen::Matrix3Xd rates(3, std::max<Eigen::Index>(n, 0));
  for (Eigen::Index k = 0; k < rates.cols(); ++k)
    rates.col(k) = (turns.col(first + (k + 1) * per) - turns.col(first + k * per)) / (per * seconds(kStep));
  if (rates.cols() > 0) rates.colwise() -= rates.rowwise().mean().eval();
  return rates;
}

/** The rotation with the largest tr(R' a b'), and how well two axes are known by it. */
struct Alignment
{
  Eigen::Matrix3d a_R_b;
  double correlation;  // sum of singular values
  double second;       // singular value
};

Alignment alignmentOf(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(a * b.transpose(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  return {svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose(), svd.singularValues().dot(sign),
          svd.singularValues()[1]};
}
/** Where between its neighbours a maximum lies, by the parabola through the three: -0.5 to 0.5. */
double peakBeside(const std::vector<double>& values, std::size_t maximum)
{
  if (maximum == 0 || maximum + 1 == values.size()) return 0;
  const double left = values[maximum - 1], right = values[maximum + 1];
  const double bend = left - 2 * values[maximum] + right;
  return bend < 0 ? 0.5 * (left - right) / bend : 0;
}
}  // namespace

std::optional<GyroAgreement> gyroAgreement(const PlacedGyro& a, const PlacedGyro& b)
{
  if (a.samples.size() < 3 || b.samples.size() < 3) return std::nullopt;
  const Timestamp start = std::max(a.samples.front().stamp, b.samples.front().stamp);
  const Timestamp end = std::min(a.samples.back().stamp, b.samples.back().stamp);
  if (end - start < 5s) return std::nullopt;
  const auto steps = static_cast<std::size_t>((end - start) / kStep);
  const Eigen::Matrix3Xd turns_a = turnsUntil(a, start, steps), turns_b = turnsUntil(b, start, steps);

  const Eigen::Matrix3Xd rates_a = meanRates(turns_a, 0);
  if (rates_a.cols() < kFewestMeans) return std::nullopt;
  std::vector<double> correlations;
  for (int lag = -kMostLagSteps; lag <= kMostLagSteps; ++lag)
  {
    const Eigen::Matrix3Xd rates_b = meanRates(turns_b, lag);
    correlations.push_back(alignmentOf(rates_a, rates_b).correlation / rates_b.norm());
  }
  const auto best = std::max_element(correlations.begin(), correlations.end()) - correlations.begin();
  const int best_lag = static_cast<int>(best) - kMostLagSteps;

  const Eigen::Matrix3Xd rates_b = meanRates(turns_b, best_lag);
  const Alignment alignment = alignmentOf(rates_a, rates_b);
  GyroAgreement agreement;
  agreement.rotation = logSo3(Eigen::Quaterniond(alignment.a_R_b));
  agreement.scale = rates_b.norm() / rates_a.norm();
  agreement.lag =
      best_lag * kStep + fromSeconds(seconds(kStep) * peakBeside(correlations, static_cast<std::size_t>(best)));
  const Eigen::Matrix3Xd residual = rates_a - alignment.a_R_b * rates_b / agreement.scale;
  const double noise = residual.norm() / std::sqrt(3.0 * static_cast<double>(residual.cols()));
  // Only the two axes with the most motion: the third follows from them.
  agreement.sigma = noise / std::sqrt(alignment.second / agreement.scale);
  if (!(agreement.sigma < kWorstSigma)) return std::nullopt;
  return agreement;
}
}  // namespace scanloom
