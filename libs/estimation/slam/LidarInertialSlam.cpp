#include "estimation/slam/LidarInertialSlam.h"

#include <utility>

namespace scanloom
{
LidarInertialSlam::LidarInertialSlam(const SlamSettings& settings, const Rigid& body_T_imu,
                                     const std::vector<MountedLidar>& lidars)
  : tracker_(settings, lidars),
    crop_(cropOf(settings.crop, lidars)),
    standstill_(settings.start),
    mounted_imu_{body_T_imu, settings.imu},
    waiting_(settings.slam.every_nth, fromSeconds(1e-3 * settings.slam.imu_wait_ms))
{
}

void LidarInertialSlam::addImu(const ImuSample& sample) { imu_.add(sample); }

void LidarInertialSlam::changeImu(const ImuChange& change)
{
  if (state_) state_ = tracker_.changeImu(std::move(*state_), change);
  mounted_imu_ = change.imu;
  imu_ = ImuBuffer();
  for (const ImuSample& sample : change.samples) addImu(sample);
}

void LidarInertialSlam::enterMap(const MapEntry& entry) { state_ = tracker_.enterMap(*state_, entry); }

std::vector<StateEstimate> LidarInertialSlam::addScan(Scan scan)
{
  if (waiting_.wants(scan)) waiting_.add(withoutMachine(std::move(scan)));
  return processWaiting();
}

std::vector<StateEstimate> LidarInertialSlam::finish()
{
  waiting_.endInput();
  return processWaiting();
}

std::vector<StateEstimate> LidarInertialSlam::processWaiting()
{
  if (!state_) state_ = startUp(waiting_, imu_, mounted_imu_, standstill_, tracker_);
  std::vector<StateEstimate> estimates;
  while (state_ && waiting_.isReady(imu_))
    estimates.push_back(times_.measure("scan", [&] { return process(waiting_.take()); }));
  return estimates;
}

Scan LidarInertialSlam::withoutMachine(Scan scan)
{
  CroppedScan cropped = times_.measure("crop", [&] { return cropOut(std::move(scan), crop_); });
  if (cropped_.size() < cropped.counts.size()) cropped_.resize(cropped.counts.size());
  for (std::size_t i = 0; i < cropped.counts.size(); ++i) cropped_[i] += cropped.counts[i];
  return std::move(cropped.scan);
}

StateEstimate LidarInertialSlam::process(Scan scan)
{
  const Timestamp from = state_->window.smoother.newest().stamp, to = scan.end();
  const bool imu_complete = imu_.covers(from, to);
  state_->trust.imu_silent = !imu_.coversDensely(from, to, kImuSilence);
  TrackedScan tracked = tracker_.step(std::move(*state_), std::move(scan), imu_.between(from, to));
  state_ = std::move(tracked.state);
  times_.add(tracked.times);
  imu_.forgetBefore(to);

  tracked.estimate.imu_complete = imu_complete;
  recoveries_ += tracked.estimate.recovered;
  map_restarts_ += tracked.estimate.map_restarted;
  return std::move(tracked.estimate);
}
}  // namespace scanloom
