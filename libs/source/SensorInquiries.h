#pragma once
#include "source/LidarMetadata.h"

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

namespace scanloom
{
/**
 * Sensors asked for their metadata in the background, each in a thread of its own, again and again until they answer:
 * those that did not at the start, and those that started anew.
 */
class SensorInquiries
{
 public:
  static constexpr Duration kFirstPause = 250ms;  // doubled after each failure
  static constexpr Duration kLongestPause = 2s;

  SensorInquiries() = default;

  /** At once: requests under way are cancelled. */
  ~SensorInquiries();

  SensorInquiries(const SensorInquiries&) = delete;
  SensorInquiries& operator=(const SensorInquiries&) = delete;

  /**
   * `lidar` is whatever number the caller wants back, `told` a failure that a person has heard of. Does nothing while
   * this lidar is being asked already.
   */
  void ask(std::size_t lidar, const LidarSensor&, const std::string& told = "");

  struct Answer
  {
    std::size_t lidar = 0;
    LidarMetadata metadata;
  };
  /** Those that came since the last call. */
  std::vector<Answer> take();

  struct Failure
  {
    std::size_t lidar = 0;
    std::string problem;
  };
  /** Whatever a person has not been told since the last call: repetitions are left out. */
  std::vector<Failure> takeFailures();

 private:
  struct Inquiry
  {
    SensorHttp* http = nullptr;  // of the request under way
    bool done = false;
    std::thread thread;
  };

  void askUntilAnswered(std::size_t lidar, LidarSensor, std::string told, Inquiry&);
  std::optional<LidarMetadata> askOnce(std::size_t lidar, LidarSensor&, std::string& told, Inquiry&);
  bool pause(Duration);

  std::mutex mutex_;
  std::condition_variable stopped_;
  bool stop_ = false;
  std::vector<Answer> answers_;
  std::vector<Failure> failures_;
  std::map<std::size_t, Inquiry> inquiries_;  // by lidar; a map's elements stay where they are
};
}  // namespace scanloom
