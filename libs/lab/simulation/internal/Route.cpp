#include "lab/simulation/internal/Route.h"

#include "lab/simulation/internal/Random.h"
#include "lab/simulation/internal/SmoothStep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
// Of the work cycle. Assumed: no published record was found.
constexpr double kStepMin = 1.0;      // m: shortest drive between two stops
constexpr double kStepMax = 3.0;      // m: longest drive between two stops
constexpr double kSpeedMin = 0.3;     // m/s: slowest of these drives
constexpr double kSpeedMax = 0.8;     // m/s: fastest of these drives
constexpr double kReturnSpeed = 1.0;  // m/s: speed of the way back

constexpr double kWorkFade = 1.0;  // s
constexpr double kTurnTime = 10;   // s: to turn round on the spot (assumed)

/** 0 before `begin`, 1 after it by `fade` and until `end`, 0 again after `end` by `fade`. */
Taylor pulse(double t, double begin, double end, double fade)
{
  const SmoothStep up = smoothStep((t - begin) / fade), down = smoothStep((t - end) / fade);
  return {up.value - down.value, (up.first - down.first) / fade, (up.second - down.second) / (fade * fade)};
}

void require(bool met, const std::string& problem)
{
  if (!met) throw std::invalid_argument(problem);
}
}  // namespace

Route::Route(const DriveOptions& drive, const WorkCycleOptions& work, std::uint64_t seed)
  : duration_(drive.duration), speed_up_(drive.speed_up), start_(drive.start)
{
  if (drive.route == "winding")
    addWinding(drive);
  else if (drive.route == "return")
    addReturn(drive);
  else if (drive.route == "work")
    addWorkCycles(drive, work, seed);
  else
    throw std::invalid_argument(
        fmt::format("[simulated_drive] route = '{}': must be winding, return or work", drive.route));
}

void Route::addWinding(const DriveOptions& drive)
{
  const double moving = drive.duration - 2 * drive.standstill - drive.speed_up;
  require(moving >= drive.speed_up,
          fmt::format("[simulated_drive] duration = {} s: must be at least 2 (standstill + speed_up) = {} s",
                      drive.duration, 2 * (drive.standstill + drive.speed_up)));
  legs_.push_back({drive.standstill, moving, 0, drive.speed, false});
  farthest_ = drive.speed * moving;
}

void Route::addReturn(const DriveOptions& drive)
{
  const double rests = 4 * drive.standstill + kTurnTime;
  const double moving = (drive.duration - rests) / 2 - drive.speed_up;
  require(moving >= drive.speed_up, fmt::format("[simulated_drive] duration = {} s: there and back takes at least {} s",
                                                drive.duration, rests + 4 * drive.speed_up));
  farthest_ = drive.speed * moving;
  legs_.push_back({drive.standstill, moving, 0, drive.speed, false});
  turns_at_ = endOf(legs_.back()) + drive.standstill;
  legs_.push_back({*turns_at_ + kTurnTime + drive.standstill, moving, farthest_, -drive.speed, false});
}

void Route::addWorkCycles(const DriveOptions& drive, const WorkCycleOptions& work, std::uint64_t seed)
{
  require(work.work_min <= work.work_max,
          fmt::format("[simulated_work] work_min = {}: must be at most work_max = {}", work.work_min, work.work_max));
  require(
      kStepMin / kSpeedMax >= drive.speed_up,
      fmt::format("[simulated_drive] speed_up = {} s: must be at most {} s, or the shortest drive between two stops "
                  "brakes before it has sped up",
                  drive.speed_up, kStepMin / kSpeedMax));
  require(work.turn_after == 0 || work.turn_after / kReturnSpeed >= drive.speed_up,
          "[simulated_work] turn_after: must be 0, or long enough to speed up on the way back");

  double x = 0;
  for (double t = drive.standstill; t < drive.duration;)
  {
    const bool returns = work.turn_after > 0 && x >= work.turn_after;
    Random random(seed, RandomStream::Work, legs_.size());
    const double step = random.uniform(kStepMin, kStepMax);
    const double speed = returns ? kReturnSpeed : random.uniform(kSpeedMin, kSpeedMax);
    const double stop = returns ? drive.standstill : random.uniform(work.work_min, work.work_max);
    const double distance = returns ? -x : step;
    legs_.push_back({t, std::abs(distance) / speed, x, std::copysign(speed, distance), !returns});
    x = returns ? 0 : x + distance;
    t = endOf(legs_.back()) + stop;
    farthest_ = std::max(farthest_, x);
  }
}

const Route::Leg* Route::legAt(double t) const
{
  const auto next =
      std::upper_bound(legs_.begin(), legs_.end(), t, [](double at, const Leg& leg) { return at < leg.begin; });
  return next == legs_.begin() ? nullptr : &*(next - 1);
}

Taylor Route::progress(double t) const
{
  const Leg* leg = legAt(t);
  if (!leg) return start_;
  const SmoothStep start = smoothStep((t - leg->begin) / speed_up_);
  const SmoothStep stop = smoothStep((t - leg->begin - leg->moving) / speed_up_);
  const Taylor moving = driving(t);
  return {start_ + leg->from + leg->speed * speed_up_ * (start.integral - stop.integral), leg->speed * moving.value,
          leg->speed * moving.rate};
}

Taylor Route::driving(double t) const
{
  const Leg* leg = legAt(t);
  return leg ? pulse(t, leg->begin, leg->begin + leg->moving, speed_up_) : 0.0;
}

Taylor Route::turned(double t) const
{
  if (!turns_at_) return 0.0;
  const SmoothStep turn = smoothStep((t - *turns_at_) / kTurnTime);
  return {M_PI * turn.value, M_PI * turn.first / kTurnTime, M_PI * turn.second / (kTurnTime * kTurnTime)};
}

Taylor Route::working(double t) const
{
  const auto stop = workStopAt(t);
  if (!stop || stop->end - stop->begin < 2 * kWorkFade) return 0.0;
  return pulse(t, stop->begin, stop->end - kWorkFade, kWorkFade);
}

std::optional<WorkStop> Route::workStopAt(double t) const
{
  const Leg* leg = legAt(t);
  if (!leg || t < endOf(*leg)) return std::nullopt;
  return workStop(static_cast<std::uint64_t>(leg - legs_.data()));
}

std::uint64_t Route::legNumberAt(double t) const
{
  const Leg* leg = legAt(t);
  return leg ? static_cast<std::uint64_t>(leg - legs_.data()) : 0;
}

std::optional<WorkStop> Route::workStop(std::uint64_t number) const
{
  if (number >= legs_.size() || !legs_[number].works) return std::nullopt;
  const double end = number + 1 < legs_.size() ? legs_[number + 1].begin : std::max(duration_, endOf(legs_[number]));
  return WorkStop{number, endOf(legs_[number]), end};
}
}  // namespace scanloom
