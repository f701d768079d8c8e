#include "estimation/imu/GyroAgreement.h"

#include "base/core/Decompositions.h"
#include "base/core/So3.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace scanloom
{
namespace
{
constexpr Duration kStep = 10ms;  // of the lag
constexpr int kMostLagSteps = 50;
constexpr Duration kReach = (kMostLagSteps + 1) * kStep;
constexpr std::size_t kFewestTurns = 30;
constexpr Duration kLeastTime = 5s;
constexpr Duration kGap = 500ms;  // between samples: what the body did meanwhile is unknown
constexpr double kWorstSigma = 5 * M_PI / 180;

struct Span
{
  Timestamp from, to;
};

std::vector<Span> spansBetweenGaps(const std::vector<ImuSample>& samples)
{
  std::vector<Span> spans{{samples.front().stamp, samples.front().stamp}};
  for (const ImuSample& sample : samples)
  {
    if (sample.stamp - spans.back().to > kGap) spans.push_back({sample.stamp, sample.stamp});
    spans.back().to = sample.stamp;
  }
  return spans;
}

/** The attitude by a gyroscope alone, relative to its first sample. */
class GyroAttitude
{
 public:
  explicit GyroAttitude(const PlacedGyro& gyro)
    : samples_(gyro.samples),
      spans_(spansBetweenGaps(samples_)),
      body_R_imu_(gyro.body_T_imu.rotation.toRotationMatrix())
  {
    attitudes_.push_back(Eigen::Quaterniond::Identity());
    for (std::size_t i = 1; i < samples_.size(); ++i)
      attitudes_.push_back(after(i - 1, samples_[i].stamp).normalized());
  }

  Timestamp begin() const { return samples_.front().stamp; }

  /** From the first sample to the last, without gaps; in order. */
  const std::vector<Span>& spans() const { return spans_; }

  bool covers(Timestamp from, Timestamp to) const
  {
    const auto next = std::upper_bound(spans_.begin(), spans_.end(), from,
                                       [](Timestamp t, const Span& span) { return t < span.from; });
    return next != spans_.begin() && to <= std::prev(next)->to;
  }

  /** Both instants within the samples; in the body's frame. */
  Eigen::Vector3d turnBetween(Timestamp from, Timestamp to) const
  {
    return body_R_imu_ * logSo3(at(from).conjugate() * at(to));
  }

 private:
  Eigen::Quaterniond at(Timestamp stamp) const
  {
    const auto next = std::upper_bound(samples_.begin() + 1, samples_.end() - 1, stamp,
                                       [](Timestamp t, const ImuSample& s) { return t < s.stamp; });
    return after(static_cast<std::size_t>(next - samples_.begin()) - 1, stamp);
  }

  Eigen::Quaterniond after(std::size_t i, Timestamp stamp) const
  {
    return attitudes_[i] * expSo3(0.5 * seconds(stamp - samples_[i].stamp) * (samples_[i].gyro + samples_[i + 1].gyro));
  }

  const std::vector<ImuSample>& samples_;
  std::vector<Span> spans_;
  Eigen::Matrix3d body_R_imu_;
  std::vector<Eigen::Quaterniond> attitudes_;
};

Eigen::Matrix3Xd withoutMean(Eigen::Matrix3Xd rates)
{
  rates.colwise() -= rates.rowwise().mean().eval();
  return rates;
}

Eigen::Matrix3Xd ratesOf(const std::vector<BodyTurn>& turns)
{
  Eigen::Matrix3Xd rates(3, static_cast<Eigen::Index>(turns.size()));
  Eigen::Index k = 0;
  for (const BodyTurn& turn : turns) rates.col(k++) = turn.rotation / seconds(turn.to - turn.from);
  return withoutMean(std::move(rates));
}

/** The same turns by the gyroscope, if its stamps are late by `lag`. */
Eigen::Matrix3Xd ratesOf(const std::vector<BodyTurn>& turns, const GyroAttitude& gyro, Duration lag)
{
  Eigen::Matrix3Xd rates(3, static_cast<Eigen::Index>(turns.size()));
  Eigen::Index k = 0;
  for (const BodyTurn& turn : turns)
    rates.col(k++) = gyro.turnBetween(turn.from + lag, turn.to + lag) / seconds(turn.to - turn.from);
  return withoutMean(std::move(rates));
}

std::vector<BodyTurn> within(const std::vector<BodyTurn>& turns, const GyroAttitude& gyro)
{
  std::vector<BodyTurn> inside;
  for (const BodyTurn& turn : turns)
    if (gyro.covers(turn.from - kReach, turn.to + kReach)) inside.push_back(turn);
  return inside;
}

Duration timeOf(const std::vector<BodyTurn>& turns)
{
  Duration sum{0};
  for (const BodyTurn& turn : turns) sum += turn.to - turn.from;
  return sum;
}

/** Offset of a maximum from its sample, by the parabola through the neighbours: -0.5 to 0.5. */
double peakBeside(const std::vector<double>& values, std::size_t maximum)
{
  if (maximum == 0 || maximum + 1 == values.size()) return 0;
  const double left = values[maximum - 1], right = values[maximum + 1];
  const double bend = left - 2 * values[maximum] + right;
  return bend < 0 ? 0.5 * (left - right) / bend : 0;
}

/** The rotation of b's rates, at the scale of a's, that leaves the least of a's. */
struct Alignment
{
  LargestTrace trace;
  double residual = 0, noise = 0;  // rad/s: norm of what is left, and its deviation about one axis
};

Alignment aligned(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b)
{
  Alignment alignment{rotationOfLargestTrace(a * b.transpose())};
  alignment.residual = (a - alignment.trace.rotation * b * (a.norm() / b.norm())).norm();
  alignment.noise = alignment.residual / std::sqrt(3.0 * static_cast<double>(a.cols()));
  return alignment;
}

/** By more than noise about the axis with the least motion explains: that alone tells left hands from right. */
bool isFarBetter(const Alignment& a, const Alignment& b)
{
  constexpr double kSigmas = 10;
  return b.residual * b.residual - a.residual * a.residual > std::pow(kSigmas * a.noise, 2);
}
}  // namespace

std::optional<GyroAgreement> gyroAgreement(const std::vector<BodyTurn>& a, const PlacedGyro& b)
{
  if (b.samples.size() < 3) return std::nullopt;
  const GyroAttitude gyro(b);
  const std::vector<BodyTurn> turns = within(a, gyro);
  if (turns.size() < kFewestTurns || timeOf(turns) < kLeastTime) return std::nullopt;

  const Eigen::Matrix3Xd rates_a = ratesOf(turns);
  std::vector<double> correlations;
  for (int lag = -kMostLagSteps; lag <= kMostLagSteps; ++lag)
  {
    const Eigen::Matrix3Xd rates_b = ratesOf(turns, gyro, lag * kStep);
    correlations.push_back(rotationOfLargestTrace(rates_a * rates_b.transpose()).singular_values.sum() /
                           rates_b.norm());
  }
  const auto best = std::max_element(correlations.begin(), correlations.end()) - correlations.begin();

  GyroAgreement agreement;
  agreement.lag = (best - kMostLagSteps) * kStep +
                  fromSeconds(seconds(kStep) * peakBeside(correlations, static_cast<std::size_t>(best)));
  const Eigen::Matrix3Xd rates_b = ratesOf(turns, gyro, agreement.lag);
  const Alignment as_given = aligned(rates_a, rates_b), reversed = aligned(rates_a, -rates_b);
  agreement.mirrored = isFarBetter(reversed, as_given);
  const Alignment& alignment = agreement.mirrored ? reversed : as_given;
  agreement.rotation = logSo3(Eigen::Quaterniond(alignment.trace.rotation));
  agreement.scale = rates_b.norm() / rates_a.norm();
  agreement.unexplained = std::pow(alignment.residual / rates_a.norm(), 2);
  const double noise = alignment.noise;
  agreement.scale_sigma = agreement.scale * (noise / rates_a.norm() + agreement.unexplained / 2);
  // By the two axes with the most motion: the third follows from them.
  agreement.sigma = noise / std::sqrt(alignment.trace.singular_values[1] / agreement.scale);
  if (!(agreement.sigma < kWorstSigma)) return std::nullopt;
  const double by_lag =
      (ratesOf(turns, gyro, agreement.lag + kStep / 2) - ratesOf(turns, gyro, agreement.lag - kStep / 2)).norm();
  agreement.lag_sigma = noise * agreement.scale * seconds(kStep) / by_lag;
  return agreement;
}

std::optional<GyroAgreement> gyroAgreement(const PlacedGyro& a, const PlacedGyro& b)
{
  constexpr Duration kTurn = 100ms;
  if (a.samples.size() < 3) return std::nullopt;
  const GyroAttitude gyro(a);
  std::vector<BodyTurn> turns;
  for (const Span& span : gyro.spans())
  {
    const std::int64_t skipped = (span.from - gyro.begin() + kTurn - 1ns) / kTurn;
    for (Timestamp from = gyro.begin() + skipped * kTurn; from + kTurn <= span.to; from += kTurn)
      turns.push_back({from, from + kTurn, gyro.turnBetween(from, from + kTurn)});
  }
  return gyroAgreement(turns, b);
}
}  // namespace scanloom
