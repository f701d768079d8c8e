#include "source/RigReplay.h"

namespace scanloom
{
RigReplay::RigReplay(const Rig& rig) : captures_(rig.captures), stream_(rig, RigStream::ReceiveTimes::OfCapture) {}

std::optional<SensorEvent> RigReplay::next(Duration)
{
  std::optional<SensorEvent> event = stream_.next();
  while (!event && !read_)
  {
    if (!stop_ && captures_.next(datagram_))
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

RigAccount RigReplay::account() const
{
  RigAccount account = stream_.account();
  const CaptureCounters captures = captures_.counters();
  account.input["datagrams"] = captures.datagrams;
  account.input["datagrams_incomplete"] = captures.fragments_expired;
  account.input["records_malformed"] = captures.malformed + captures.cut_short;
  return account;
}
}  // namespace scanloom
