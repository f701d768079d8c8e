#include "mrpt/edit/internal/DeskewByGyro.h"

#include "estimation/imu/ImuBuffer.h"
#include "estimation/imu/Preintegration.h"
#include "estimation/preprocessing/Deskew.h"
#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/internal/DeskewClouds.h"
#include "mrpt/edit/internal/GyroBias.h"
#include "mrpt/observations/Observations.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <stdexcept>

namespace scanloom
{
namespace
{
// Drivers write a scan within a fraction of a second of its IMU samples; after this time none are expected.
constexpr Duration kLongestWait = 1s;
constexpr Duration kKeptSamples = 10s;

/** Rotation of the body at each column against the scan's start; translations are zero. */
std::vector<Rigid> attitudes(const Scan& scan, const ImuBuffer& imu, const Eigen::Vector3d& bias,
                             const Eigen::Quaterniond& body_R_imu)
{
  if (scan.columns.empty()) return {};
  NavState start;
  start.stamp = scan.start;
  start.bias.gyro = bias;
  std::vector<Timestamp> stamps;
  for (const Column& column : scan.columns) stamps.push_back(column.stamp);
  std::vector<Rigid> start_T_column;
  const Timestamp end = std::max(stamps.back(), scan.start + 1ns);
  for (const NavState& state : predictAt(start, imu.between(scan.start, end), stamps))
    start_T_column.push_back({body_R_imu * state.map_T_imu.rotation * body_R_imu.conjugate(), Eigen::Vector3d::Zero()});
  return start_T_column;
}

class GyroDeskew
{
 public:
  GyroDeskew(GyroInUse gyro, std::optional<RecordingHeader> header) : gyro_(std::move(gyro)), header_(std::move(header))
  {
  }

  Observations operator()(const ObservationPtr& observation)
  {
    if (!observation) return finish();
    take(*observation);
    waiting_.push_back({observation, scanIn(observation)});
    Observations released;
    while (!waiting_.empty() && isDue(waiting_.front())) release(released);
    return released;
  }

 private:
  struct Waiting
  {
    ObservationPtr observation;
    std::optional<Scan> scan;
  };

  void take(const mrpt::obs::CObservation& observation)
  {
    latest_ = std::max(latest_, fromMrpt(observation.timestamp));
    const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation);
    const auto recorded = imu && imu->sensorLabel == gyro_.label ? fromObservation(*imu) : std::nullopt;
    if (!recorded || !imu_.add(recorded->sample)) return;
    body_R_imu_ = recorded->body_T_imu.rotation;
    imu_.forgetBefore(recorded->sample.stamp - kKeptSamples);
  }

  std::optional<Scan> scanIn(const ObservationPtr& observation) const
  {
    const auto cloud = cloudIn(observation);
    if (!cloud) return std::nullopt;
    return timedScanOf(*cloud, header_);
  }

  static Timestamp lastColumn(const Scan& scan)
  {
    return scan.columns.empty() ? scan.start : scan.columns.back().stamp;
  }

  bool isDue(const Waiting& waiting) const
  {
    if (!waiting.scan) return true;
    const Timestamp end = lastColumn(*waiting.scan);
    return imu_.covers(waiting.scan->start, end) || latest_ > end + kLongestWait;
  }

  void release(Observations& released)
  {
    Waiting front = std::move(waiting_.front());
    waiting_.pop_front();
    if (!front.scan)
      released.push_back(std::move(front.observation));
    else if (imu_.coversDensely(front.scan->start, lastColumn(*front.scan), kWidestImuGap))
    {
      const std::vector<Rigid> start_T_column = attitudes(*front.scan, imu_, gyro_.bias, body_R_imu_);
      released.push_back(withPositions(*cloudIn(front.observation), deskew(std::move(*front.scan), start_T_column)));
      ++deskewed_;
    }
    else
      ++without_samples_;
  }

  Observations finish()
  {
    Observations released;
    while (!waiting_.empty()) release(released);
    if (deskewed_ == 0 && without_samples_ > 0)
      throw std::runtime_error(
          fmt::format("none of {} clouds lies within the samples of '{}': do both use the same clock?",
                      without_samples_, gyro_.label));
    return released;
  }

  GyroInUse gyro_;
  std::optional<RecordingHeader> header_;
  ImuBuffer imu_;
  Eigen::Quaterniond body_R_imu_ = Eigen::Quaterniond::Identity();
  Timestamp latest_ = Timestamp::min();
  std::deque<Waiting> waiting_;
  std::uint64_t deskewed_ = 0, without_samples_ = 0;
};
}  // namespace

RawlogOperation deskewByGyro(const GyroInUse& gyro, const std::optional<RecordingHeader>& header)
{
  return GyroDeskew(gyro, header);
}
}  // namespace scanloom
