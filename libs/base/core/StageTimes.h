/** Wall-clock time per stage of a pipeline, for reports. */
#pragma once
#include "base/core/internal/DurationHistogram.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace scanloom
{
struct StageTime
{
  std::uint64_t runs = 0;
  double total_ms = 0;
  double longest_ms = 0;
  DurationHistogram histogram;

  void add(double ms)
  {
    ++runs;
    total_ms += ms;
    longest_ms = std::max(longest_ms, ms);
    histogram.add(ms);
  }
};

class StageTimes
{
 public:
  /** Calls `work`, adds its duration to `stage`, and returns its result. */
  template <typename Work>
  auto measure(const std::string& stage, Work&& work)
  {
    const Stopwatch stopwatch(stages_[stage]);
    return std::forward<Work>(work)();
  }

  const std::map<std::string, StageTime>& stages() const { return stages_; }

 private:
  class Stopwatch
  {
   public:
    explicit Stopwatch(StageTime& stage) : stage_(stage) {}
    ~Stopwatch()
    {
      const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start_;
      stage_.add(ms.count());
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

   private:
    StageTime& stage_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  };

  std::map<std::string, StageTime> stages_;
};
}  // namespace scanloom
