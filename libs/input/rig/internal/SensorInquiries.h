#pragma once
#include "input/rig/internal/LidarMetadata.h"

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

namespace scanloom
{
/**
 * Asks sensors for their metadata in the background, each in a thread of its own, again and again until it answers.
 */
class SensorInquiries
{
 public:
  static constexpr Duration kFirstPause = 250ms;  // doubled after each failure
  static constexpr Duration kLongestPause = 2s;

  SensorInquiries() = default;

  /** Does not wait for answers: requests under way are cancelled. */
  ~SensorInquiries();

  SensorInquiries(const SensorInquiries&) = delete;
  SensorInquiries& operator=(const SensorInquiries&) = delete;

  /**
   * `lidar` is returned with the answer; `reported` is a failure that a person already knows. Does nothing while this
   * lidar is being asked.
   */
  void ask(std::size_t lidar, const LidarSensor&, const std::string& reported = "");

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
  /** Those since the last call; the same failure is given once. */
  std::vector<Failure> takeFailures();

 private:
  struct Inquiry
  {
    SensorHttp* http = nullptr;  // of the request under way
    bool done = false;
    std::thread thread;
  };

  void askUntilAnswered(std::size_t lidar, LidarSensor, std::string reported, Inquiry&);
  std::optional<LidarMetadata> askOnce(std::size_t lidar, LidarSensor&, std::string& reported, Inquiry&);
  bool pause(Duration);

  std::mutex mutex_;
  std::condition_variable stopped_;
  bool stop_ = false;
  std::vector<Answer> answers_;
  std::vector<Failure> failures_;
  std::map<std::size_t, Inquiry> inquiries_;  // by lidar; a map's elements stay where they are
};
}  // namespace scanloom
