/** Warnings of an input while it is read. */
#pragma once
#include "input/rig/SensorInput.h"

#include <chrono>
#include <string>
#include <vector>

namespace scanloom
{
/** Asks once a second at most: the thread that reads files ahead holds the input's warnings while it reads. */
class InputWarnings
{
 public:
  std::vector<std::string> due(SensorInput& input)
  {
    constexpr std::chrono::seconds kPause{1};
    if (Clock::now() - asked_ < kPause) return {};
    asked_ = Clock::now();
    return input.takeWarnings();
  }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point asked_{};
};
}  // namespace scanloom
