/** runSlam() in a thread of its own, which gives its poses one by one. */
#pragma once
#include "InputWarnings.h"
#include "Pose.h"
#include "base/core/BoundedQueue.h"
#include "input/rig/RepeatedWarnings.h"
#include "run/run/SlamRun.h"

#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace scanloom
{
/** Never touches Python: the GIL is not needed here, and should be released by who waits. */
class SlamThread
{
 public:
  /** The thread waits while `ahead` poses were not taken. The input must outlive this. */
  SlamThread(SensorInput&, const SlamSettings&, KeptClouds, std::size_t ahead, const GivenMap& = {});
  SlamThread(const SlamThread&) = delete;
  SlamThread& operator=(const SlamThread&) = delete;
  ~SlamThread();

  /** Nothing if no pose came within `patience`, and nothing at the end. Throws once what runSlam() throws. */
  std::optional<Pose> next(Duration patience) { return poses_.pop(patience); }

  /** All poses were taken. */
  bool ended() const { return poses_.ended(); }

  /** Ends the run after the scan that it is at, and returns when it has ended. */
  void stop();

  /** Those since the last call. */
  std::vector<std::string> takeWarnings();

  /** None before the end, and where runSlam() threw. */
  const std::optional<SlamRunResult>& result() const { return result_; }

 private:
  void run(const SlamSettings&, const GivenMap&);
  void warn(const std::string&);

  SensorInput& input_;
  KeptClouds kept_;
  BoundedQueue<Pose> poses_;
  std::atomic<bool> stop_{false};
  InputWarnings input_warnings_;
  std::mutex warning_;  // of the two below
  RepeatedWarnings repeated_;
  std::vector<std::string> warnings_;
  std::optional<SlamRunResult> result_;
  std::thread thread_;  // last: it uses all of the above
};
}  // namespace scanloom
