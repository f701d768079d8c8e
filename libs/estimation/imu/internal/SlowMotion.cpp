#include "estimation/imu/internal/SlowMotion.h"

#include "base/core/Statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scanloom
{
namespace
{
constexpr double kSlow = 3;                      // Hz
constexpr double kNoiseFrom = 5, kNoiseTo = 20;  // Hz
constexpr double kNoiseMargin = 2;               // white noise is so much stronger below 3 Hz one time in 1000

struct Weighted
{
  double time;    // s since the first sample
  double weight;  // the sum is 1
};

std::vector<Weighted> hannWindow(const std::vector<ImuSample>& samples)
{
  const Timestamp first = samples.front().stamp;
  const double length = seconds(samples.back().stamp - first);
  std::vector<Weighted> window;
  double sum = 0;
  for (const ImuSample& sample : samples)
  {
    const double time = seconds(sample.stamp - first);
    window.push_back({time, 1 - std::cos(2 * M_PI * time / length)});
    sum += window.back().weight;
  }
  for (Weighted& w : window) w.weight /= sum;
  return window;
}

/** Of one reading of all samples, and its mean. */
class Spectrum
{
 public:
  Spectrum(const std::vector<ImuSample>& samples, const std::vector<Weighted>& window,
           Eigen::Vector3d ImuSample::*reading)
    : window_(window)
  {
    for (std::size_t i = 0; i < samples.size(); ++i) mean_ += window[i].weight * samples[i].*reading;
    for (const ImuSample& sample : samples) deviations_.push_back(sample.*reading - mean_);
  }

  const Eigen::Vector3d& mean() const { return mean_; }

  /** Root mean square over all frequencies. */
  double deviation() const
  {
    double sum = 0;
    for (std::size_t i = 0; i < window_.size(); ++i) sum += window_[i].weight * deviations_[i].squaredNorm();
    return std::sqrt(sum);
  }

  /** The variance that the mean has if every frequency is as strong as this one, in Hz. Sum of the axes. */
  double power(double frequency) const
  {
    Eigen::Vector3d in_phase(0, 0, 0), across(0, 0, 0);
    for (std::size_t i = 0; i < window_.size(); ++i)
    {
      const double phase = 2 * M_PI * frequency * window_[i].time;
      in_phase += window_[i].weight * std::cos(phase) * deviations_[i];
      across += window_[i].weight * std::sin(phase) * deviations_[i];
    }
    return in_phase.squaredNorm() + across.squaredNorm();
  }

 private:
  const std::vector<Weighted>& window_;
  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> deviations_;
};

/** At the multiples of 1 / length, which a Hann window keeps apart. */
std::vector<double> powers(const Spectrum& spectrum, double length, double from, double to)
{
  std::vector<double> powers;
  const auto last = static_cast<int>(to * length);
  for (int k = std::max(1, static_cast<int>(std::ceil(from * length))); k <= last; ++k)
    powers.push_back(spectrum.power(k / length));
  return powers;
}

struct SlowPart
{
  double deviation;      // of the axes together
  double sigma_of_mean;  // of each axis
};

SlowPart slowPart(const Spectrum& spectrum, double length, double highest)
{
  const std::vector<double> slow = powers(spectrum, length, 0, kSlow);
  const double sum = std::accumulate(slow.begin(), slow.end(), 0.0), count = static_cast<double>(slow.size());
  const std::vector<double> fast = powers(spectrum, length, kNoiseFrom, highest);
  const double noise = fast.empty() ? 0 : kNoiseMargin * count * median(fast);
  constexpr double kOfHann = 4.0 / 3;  // variance of a line over its powers at the multiples
  constexpr double kAxes = 3;
  return {std::sqrt(kOfHann * std::max(0.0, sum - noise)), std::sqrt(sum / count / kAxes)};
}
}  // namespace

SlowMotion slowMotion(const std::vector<ImuSample>& samples)
{
  const double length = seconds(samples.back().stamp - samples.front().stamp);
  const double rate = static_cast<double>(samples.size() - 1) / length;
  const double highest = std::min(kNoiseTo, 0.4 * rate);
  const std::vector<Weighted> window = hannWindow(samples);
  const Spectrum gyro(samples, window, &ImuSample::gyro), accel(samples, window, &ImuSample::accel);
  const SlowPart of_gyro = slowPart(gyro, length, highest), of_accel = slowPart(accel, length, highest);
  return {gyro.mean(),           accel.mean(),           of_gyro.deviation, of_accel.deviation,
          of_gyro.sigma_of_mean, of_accel.sigma_of_mean, gyro.deviation(),  accel.deviation()};
}
}  // namespace scanloom
