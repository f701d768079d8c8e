#include "mrpt/edit/internal/TimeOffset.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/internal/RawlogLabels.h"
#include "mrpt/observations/RawlogReader.h"

#include <mrpt/obs/CObservationPointCloud.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace scanloom
{
namespace
{
using Ticks = mrpt::Clock::duration;  // of 100 ns

constexpr std::size_t kMostHeld = 20000;   // in IMU samples: about 5 MB
constexpr std::size_t kCloudWeight = 100;  // a cloud counts as so many samples: 200 clouds, about 600 MB

bool isCloud(const mrpt::obs::CObservation& observation)
{
  return dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation) != nullptr;
}

/** A queue of observations in the order of the file, each with its due time; due times never go back. */
class Lane
{
 public:
  void add(const ObservationPtr& observation, Timestamp due)
  {
    latest_ = std::max(latest_, due);
    waiting_.push_back({observation, latest_});
    held_ += weightOf(*observation);
  }

  ObservationPtr take()
  {
    const ObservationPtr observation = waiting_.front().observation;
    held_ -= weightOf(*observation);
    waiting_.pop_front();
    return observation;
  }

  bool empty() const { return waiting_.empty(); }
  std::size_t held() const { return held_; }

  /** The due time of the next observation to come out, or a lower bound of it. */
  Timestamp next() const { return waiting_.empty() ? latest_ : waiting_.front().due; }

 private:
  struct Waiting
  {
    ObservationPtr observation;
    Timestamp due;
  };
  static std::size_t weightOf(const mrpt::obs::CObservation& o) { return isCloud(o) ? kCloudWeight : 1; }

  std::deque<Waiting> waiting_;
  Timestamp latest_ = Timestamp::min();
  std::size_t held_ = 0;
};

class TimeOffset
{
 public:
  TimeOffset(const std::string& label, Duration offset, Duration period)
    : label_({label}), offset_(std::llround(static_cast<double>(offset.count()) / 100)), period_(period)
  {
  }

  Observations operator()(const ObservationPtr& observation)
  {
    if (!observation)
    {
      label_.requireAllSeen();
      return takeWhile([](const Lane&, const Lane&) { return true; });
    }
    if (headerIn(*observation)) return {observation};
    const bool moved = label_.contain(*observation);
    if (moved) observation->timestamp += offset_;
    const Timestamp due = fromMrpt(observation->timestamp) + (isCloud(*observation) ? period_ : Duration{0});
    (moved ? moved_ : others_).add(observation, due);
    return takeWhile([](const Lane& first, const Lane& other)
                     { return first.next() <= other.next() || first.held() + other.held() > kMostHeld; });
  }

 private:
  template <typename Condition>
  Observations takeWhile(const Condition& ready)
  {
    Observations taken;
    for (;;)
    {
      const bool others_first = moved_.empty() || (!others_.empty() && others_.next() <= moved_.next());
      Lane& first = others_first ? others_ : moved_;
      if (first.empty() || !ready(first, others_first ? moved_ : others_)) return taken;
      taken.push_back(first.take());
    }
  }

  WantedLabels label_;
  Ticks offset_;
  Duration period_;
  Lane moved_, others_;
};
}  // namespace

RawlogOperation addTimeOffset(const std::string& label, Duration offset, Duration period)
{
  return TimeOffset(label, offset, period);
}
}  // namespace scanloom
