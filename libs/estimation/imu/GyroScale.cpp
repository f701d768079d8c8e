#include "estimation/imu/GyroScale.h"

#include "base/core/So3.h"
#include "estimation/imu/NavState.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kWindow = 0.25;  // s: the engine's vibration averages out, sway of 1 Hz does not
constexpr std::size_t kWindowsApart = 2;
constexpr std::ptrdiff_t kEdge = 8;  // the rates at a window's ends are means over this share of it, to reduce noise
constexpr std::size_t kFewestPairs = 18;

/** Means of one window. */
struct Window
{
  Timestamp begin;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d turned = Eigen::Vector3d::Zero();  // rad, the integral of the rates since the first sample
  Eigen::Vector3d angular_acceleration = Eigen::Vector3d::Zero();
};

/** `turned`: by the sample, since the first of all. */
Window meanOf(const ImuSample* first, const ImuSample* last, const Eigen::Vector3d* turned)
{
  Window window;
  window.begin = first->stamp;
  const auto n = static_cast<double>(last - first + 1);
  for (const ImuSample* sample = first; sample <= last; ++sample, ++turned)
  {
    window.force += sample->accel / n;
    window.turned += *turned / n;
  }
  const auto edge = std::max<std::ptrdiff_t>(1, (last - first + 1) / kEdge);
  for (std::ptrdiff_t i = 0; i < edge; ++i)
    window.angular_acceleration += (last[-i].gyro - first[i].gyro) / static_cast<double>(edge);
  window.angular_acceleration /= seconds(last->stamp - first[edge - 1].stamp);
  return window;
}

std::vector<Eigen::Vector3d> integralOfRates(const std::vector<ImuSample>& samples)
{
  std::vector<Eigen::Vector3d> turned{Eigen::Vector3d::Zero()};
  for (std::size_t i = 1; i < samples.size(); ++i)
    turned.push_back(turned.back() +
                     0.5 * seconds(samples[i].stamp - samples[i - 1].stamp) * (samples[i - 1].gyro + samples[i].gyro));
  return turned;
}

/** Consecutive; none for an IMU below 8 Hz. */
std::vector<Window> windowsOf(const std::vector<ImuSample>& samples)
{
  const std::vector<Eigen::Vector3d> turned = integralOfRates(samples);
  std::vector<Window> windows;
  for (std::size_t first = 0; first < samples.size();)
  {
    const Timestamp end = samples[first].stamp + fromSeconds(kWindow);
    std::size_t next = first;
    while (next < samples.size() && samples[next].stamp < end) ++next;
    if (next == samples.size() || next - first < 2) break;
    windows.push_back(meanOf(&samples[first], &samples[next - 1], &turned[first]));
    first = next;
  }
  return windows;
}

using Unknowns = Eigen::Matrix<double, 4, 1>;  // scale, scale * r
struct Row3
{
  Eigen::Matrix<double, 3, 4> regressors;
  Eigen::Vector3d seen;
};

std::vector<Row3> rowsOf(const std::vector<Window>& windows)
{
  std::vector<Row3> rows;
  for (std::size_t k = 0; k + kWindowsApart < windows.size(); ++k)
  {
    const Window &from = windows[k], &to = windows[k + kWindowsApart];
    if (seconds(to.begin - from.begin) > (kWindowsApart + 1) * kWindow) continue;  // nobody saw it turn meanwhile
    Row3 row;
    row.regressors << -(to.turned - from.turned).cross(0.5 * (from.force + to.force)),
        skew(to.angular_acceleration - from.angular_acceleration);
    row.seen = to.force - from.force;
    rows.push_back(row);
  }
  return rows;
}

/** Removes the means, and returns them. */
Row3 centre(std::vector<Row3>& rows)
{
  Row3 mean{Eigen::Matrix<double, 3, 4>::Zero(), Eigen::Vector3d::Zero()};
  for (const Row3& row : rows)
  {
    mean.regressors += row.regressors / static_cast<double>(rows.size());
    mean.seen += row.seen / static_cast<double>(rows.size());
  }
  for (Row3& row : rows)
  {
    row.regressors -= mean.regressors;
    row.seen -= mean.seen;
  }
  return mean;
}
}  // namespace

std::optional<GyroScale> gyroScale(const std::vector<ImuSample>& samples)
{
  std::vector<Row3> rows = rowsOf(windowsOf(samples));
  if (rows.size() < kFewestPairs) return std::nullopt;
  const Row3 mean = centre(rows);

  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  Unknowns right = Unknowns::Zero();
  for (const Row3& row : rows)
  {
    information += row.regressors.transpose() * row.regressors;
    right += row.regressors.transpose() * row.seen;
  }
  const Eigen::LLT<Eigen::Matrix4d> solver(information);
  if (solver.info() != Eigen::Success) return std::nullopt;
  const Unknowns solution = solver.solve(right);

  double squares = 0;
  for (const Row3& row : rows) squares += (row.seen - row.regressors * solution).squaredNorm();
  // Pairs overlap: only one in kWindowsApart is independent.
  const double variance = kWindowsApart * squares / (3 * static_cast<double>(rows.size()));
  GyroScale result;
  result.scale = solution[0];
  const double inverse = solver.solve(Unknowns::Unit(0))[0];
  result.sigma = std::sqrt(variance * inverse);
  const double by_gravity = solution[0] * solution[0] / inverse;  // the squares that the fit without scale leaves more
  result.explained = by_gravity / (by_gravity + squares);
  result.tilt_rate = mean.regressors.col(0).norm() / (kWindowsApart * kWindow * kGravity);
  return result;
}
}  // namespace scanloom
