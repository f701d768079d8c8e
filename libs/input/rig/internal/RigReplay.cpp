#include "input/rig/internal/RigReplay.h"

#include "input/bags/BagPackets.h"
#include "input/rig/internal/ReceivePace.h"

#include <fmt/format.h>

#include <utility>

namespace scanloom
{
RigReplay::RigReplay(const Rig& rig)
  : setup_(setupOf(rig)),
    captures_(datagramsOf(rig.captures)),
    stream_(rig, RigStream::ReceiveTimes::OfCapture),
    notes_(rig.notes)
{
  constexpr std::size_t kLookedAt = 500, kBytes = 16'000'000;  // datagrams; those of a bag's clouds are large
  for (std::size_t bytes = 0; first_.size() < kLookedAt && bytes < kBytes && captures_.next(datagram_);)
  {
    bytes += datagram_.payload.size();
    first_.push_back(datagram_);
  }
  if (first_.empty()) return;
  begin_ = first_.front().received;
  pace_ = receivePace(routesOf(rig), first_);
  if (pace_ != 1)
    notes_.push_back(
        fmt::format("times of reception run {:g} times as fast as the sensors' clocks: they are taken to be "
                    "in a wrong unit, and divided by it",
                    pace_));
}

/** The next of all, with a time of reception in the sensors' unit, into datagram_; false at the end. */
bool RigReplay::readDatagram()
{
  if (taken_ < first_.size())
  {
    datagram_ = std::move(first_[taken_++]);
    if (taken_ == first_.size()) first_ = {}, taken_ = 0;
  }
  else if (!captures_.next(datagram_))
    return false;
  if (pace_ != 1) datagram_.received = begin_ + fromSeconds(seconds(datagram_.received - begin_) / pace_);
  return true;
}

std::optional<SensorEvent> RigReplay::next(Duration)
{
  std::optional<SensorEvent> event = stream_.next();
  while (!event && !read_)
  {
    if (!stop_ && readDatagram())
      stream_.take(datagram_);
    else
    {
      read_ = true;
      stream_.finish();
    }
    event = stream_.next();
  }
  ended_ = !event;
  return event;
}

std::vector<std::string> RigReplay::takeWarnings()
{
  std::vector<std::string> warnings = std::exchange(notes_, {});
  for (std::string& warning : stream_.takeWarnings()) warnings.push_back(std::move(warning));
  const CaptureCounters captures = captures_.counters();
  if (captures.truncated && !std::exchange(warned_of_cut_, true))
    warnings.push_back("a capture ends inside a record: everything before it was read");
  for (; warned_of_damages_ < captures.damages.size(); ++warned_of_damages_)
    warnings.push_back(captures.damages[warned_of_damages_]);
  return warnings;
}

RigAccount RigReplay::account() const
{
  RigAccount account = stream_.account();
  const CaptureCounters captures = captures_.counters();
  account.input["datagrams"] = captures.datagrams;
  account.input["datagrams_incomplete"] = captures.fragments_expired;
  account.input["records_malformed"] = captures.malformed + captures.cut_short;
  account.input[kDamagedInputs] = captures.damages.size();
  return account;
}
}  // namespace scanloom
