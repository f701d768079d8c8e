#include "estimation/slam/internal/BiasOfReplacement.h"

#include "estimation/imu/ImuBuffer.h"

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr Duration kLeast = 1s;

struct MeanReading
{
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero(), accel = Eigen::Vector3d::Zero();
};

/** Over time, by trapezoids, because intervals between samples differ. */
MeanReading meanOverTime(const std::vector<ImuSample>& samples)
{
  MeanReading means;
  const double length = seconds(samples.back().stamp - samples.front().stamp);
  for (std::size_t i = 1; i < samples.size(); ++i)
  {
    const double share = 0.5 * seconds(samples[i].stamp - samples[i - 1].stamp) / length;
    means.gyro += share * (samples[i - 1].gyro + samples[i].gyro);
    means.accel += share * (samples[i - 1].accel + samples[i].accel);
  }
  return means;
}
}  // namespace

std::optional<ImuBias> biasOfReplacement(const std::vector<ImuSample>& known, const ImuBias& known_bias,
                                         const std::vector<ImuSample>& other, const Rigid& known_T_other)
{
  const ImuBuffer known_buffer(known), other_buffer(other);
  if (known_buffer.empty() || other_buffer.empty()) return std::nullopt;
  const Timestamp from = std::max(known_buffer.samples().front().stamp, other_buffer.samples().front().stamp);
  const Timestamp to = std::min(known_buffer.samples().back().stamp, other_buffer.samples().back().stamp);
  if (to - from < kLeast) return std::nullopt;

  std::vector<ImuSample> true_known = known_buffer.between(from, to);
  for (ImuSample& sample : true_known)
  {
    sample.gyro -= known_bias.gyro;
    sample.accel -= known_bias.accel;
  }
  const Eigen::Vector3d lever = known_T_other.translation;
  const Eigen::Vector3d turned = (true_known.back().gyro - true_known.front().gyro) / seconds(to - from);
  for (ImuSample& sample : true_known) sample.accel += sample.gyro.cross(sample.gyro.cross(lever));

  const MeanReading expected = meanOverTime(true_known), read = meanOverTime(other_buffer.between(from, to));
  const Eigen::Quaterniond other_R_known = known_T_other.rotation.conjugate();
  return ImuBias{read.gyro - other_R_known * expected.gyro,
                 read.accel - other_R_known * (expected.accel + turned.cross(lever))};
}
}  // namespace scanloom
