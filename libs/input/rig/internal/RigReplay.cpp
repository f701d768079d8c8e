#include "input/rig/internal/RigReplay.h"

#include <utility>

namespace scanloom
{
RigReplay::RigReplay(const Rig& rig)
  : setup_(setupOf(rig)), captures_(rig), stream_(rig, RigStream::ReceiveTimes::OfCapture)
{
}

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

std::vector<std::string> RigReplay::takeWarnings()
{
  std::vector<std::string> warnings = captures_.takeWarnings();
  for (std::string& warning : stream_.takeWarnings()) warnings.push_back(std::move(warning));
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
