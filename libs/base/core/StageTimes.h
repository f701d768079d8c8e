/** Wall-clock time per stage of a pipeline, for reports. */
#pragma once
#include "base/core/internal/DurationHistogram.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/** Single runs of stages, which a function returns beside its result. */
class StageRuns
{
 public:
  struct Run
  {
    std::string_view stage;  // of a literal
    double ms;
  };

  /** Calls `work`, notes its duration for `stage`, and returns its result. */
  template <typename Work>
  auto measure(std::string_view stage, Work&& work)
  {
    const auto start = std::chrono::steady_clock::now();
    auto result = std::forward<Work>(work)();
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
    runs_.push_back({stage, ms.count()});
    return result;
  }

  const std::vector<Run>& all() const { return runs_; }

  friend StageRuns operator+(StageRuns a, const StageRuns& b)
  {
    a.runs_.insert(a.runs_.end(), b.runs_.begin(), b.runs_.end());
    return a;
  }

 private:
  std::vector<Run> runs_;
};

/** A result, and what it has taken. */
template <typename Result>
struct Timed
{
  Result value;
  StageRuns times;
};
template <typename Result>
Timed(Result, StageRuns) -> Timed<Result>;

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

  void add(const StageRuns& runs)
  {
    for (const StageRuns::Run& run : runs.all()) stages_[std::string(run.stage)].add(run.ms);
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
