#include "input/rig/internal/SensorInquiries.h"

#include <algorithm>
#include <utility>

namespace scanloom
{
SensorInquiries::~SensorInquiries()
{
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    for (auto& [lidar, inquiry] : inquiries_)
      if (inquiry.http) inquiry.http->cancel();
  }
  stopped_.notify_all();
  for (auto& [lidar, inquiry] : inquiries_) inquiry.thread.join();
}

void SensorInquiries::ask(std::size_t lidar, const LidarSensor& sensor, const std::string& reported)
{
  const std::lock_guard lock(mutex_);
  const auto known = inquiries_.find(lidar);
  if (known != inquiries_.end())
  {
    if (!known->second.done) return;
    known->second.thread.join();  // it has nothing left to do
    inquiries_.erase(known);
  }
  Inquiry& inquiry = inquiries_[lidar];
  inquiry.thread =
      std::thread([this, lidar, sensor, reported, &inquiry] { askUntilAnswered(lidar, sensor, reported, inquiry); });
}

std::vector<SensorInquiries::Answer> SensorInquiries::take()
{
  const std::lock_guard lock(mutex_);
  return std::exchange(answers_, {});
}

std::vector<SensorInquiries::Failure> SensorInquiries::takeFailures()
{
  const std::lock_guard lock(mutex_);
  return std::exchange(failures_, {});
}

void SensorInquiries::askUntilAnswered(std::size_t lidar, LidarSensor sensor, std::string reported, Inquiry& inquiry)
{
  for (Duration wait = kFirstPause;; wait = std::min(2 * wait, kLongestPause))
  {
    if (std::optional<LidarMetadata> metadata = askOnce(lidar, sensor, reported, inquiry))
    {
      const std::lock_guard lock(mutex_);
      answers_.push_back({lidar, *std::move(metadata)});
      inquiry.done = true;
      return;
    }
    if (!pause(wait)) return;
  }
}

std::optional<LidarMetadata> SensorInquiries::askOnce(std::size_t lidar, LidarSensor& sensor, std::string& reported,
                                                      Inquiry& inquiry)
{
  SensorHttp http(sensor.address, kRigHttpLimits);
  const auto announce = [&](SensorHttp* under_way)
  {
    const std::lock_guard lock(mutex_);
    inquiry.http = under_way;
    return !stop_;
  };
  std::optional<LidarMetadata> metadata;
  std::string problem;
  if (!announce(&http)) return std::nullopt;
  try
  {
    metadata = metadataOf(http, sensor);
  }
  catch (const std::exception& failure)  // in a thread of its own nothing may escape
  {
    problem = failure.what();
  }
  announce(nullptr);
  if (!metadata && problem != reported)
  {
    const std::lock_guard lock(mutex_);
    failures_.push_back({lidar, reported = problem});
  }
  return metadata;
}

/** False if all is to end. */
bool SensorInquiries::pause(Duration time)
{
  std::unique_lock lock(mutex_);
  return !stopped_.wait_for(lock, time, [this] { return stop_; });
}
}  // namespace scanloom
