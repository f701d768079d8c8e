/** How far a verb is with its input: a bar where the end is known, the lidars' state where it is not. */
#pragma once
#include "LiveStatus.h"
#include "Progress.h"

#include <optional>
#include <string>

namespace scanloom
{
class InputDisplay
{
 public:
  /** Of an input with so many `unit`s; 0: no telling, scans are counted. */
  InputDisplay(const std::string& verb, std::uint64_t total, const std::string& unit);

  /** Of live lidars, which must outlive it. */
  InputDisplay(const std::string& verb, RigInput&);

  /** The share of the input that was read, and the scans so far. */
  void update(double share, std::uint64_t scans, const Work& = {});

 private:
  std::uint64_t total_ = 0;
  RigInput* input_ = nullptr;  // live
  std::optional<Progress> replay_;
  std::optional<LiveStatus> live_;
};
}  // namespace scanloom
