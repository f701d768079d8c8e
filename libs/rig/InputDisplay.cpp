#include "rig/InputDisplay.h"

namespace scanloom
{
InputDisplay::InputDisplay(const std::string& verb, std::uint64_t total, const std::string& unit) : total_(total)
{
  replay_.emplace(verb, total, total > 0 ? unit : "scans");
}

InputDisplay::InputDisplay(const std::string& verb, SensorInput& input) : input_(&input) { live_.emplace(verb); }

void InputDisplay::update(double share, std::uint64_t scans, const Work& work)
{
  if (live_) return live_->update(*input_, work);
  replay_->update(total_ > 0 ? static_cast<std::uint64_t>(share * static_cast<double>(total_)) : scans);
}
}  // namespace scanloom
