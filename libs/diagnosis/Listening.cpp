#include "diagnosis/Listening.h"

#include "input/bags/BagPackets.h"
#include "input/packets/MergedCaptures.h"
#include "input/rig/receiverOptions.h"

#include <chrono>

namespace scanloom
{
namespace
{
DatagramView viewOf(const DatagramRing::Slot& slot, std::uint16_t port)
{
  DatagramView datagram;
  datagram.received = slot.received;
  datagram.source = slot.source;
  datagram.source_port = slot.source_port;
  datagram.destination_port = port;
  datagram.payload = {slot.bytes, slot.size};
  return datagram;
}

SocketAccount accountOf(const UdpReceiver& receiver)
{
  SocketAccount account;
  for (std::size_t i = 0; i < receiver.ports(); ++i) account.counters += receiver.counters(i);
  account.clock_steps = receiver.clockSteps();
  account.warnings = receiver.warnings();
  return account;
}
}  // namespace

void listenLive(const Rig& rig, Duration longest, RigListener& listener, const std::function<bool()>& goOn)
{
  using Clock = std::chrono::steady_clock;
  UdpReceiver receiver(receiverOptions(rig));
  const Clock::time_point end = Clock::now() + longest;
  for (bool last = false; !last;)
  {
    receiver.wait(100ms);
    last = receiver.ended();
    const Timestamp drained = last ? Timestamp::max() : receiver.drainedUntil();
    while (const std::optional<std::size_t> port = receiver.oldestBefore(drained))
    {
      listener.add(viewOf(*receiver.ring(*port).front(), receiver.port(*port)));
      receiver.ring(*port).pop();
    }
    if (Clock::now() >= end || !goOn()) receiver.stop();
  }
  listener.add(accountOf(receiver));
}

std::vector<std::string> listenToCaptures(const Rig& rig, Duration longest, RigListener& listener,
                                          const std::function<bool(double)>& goOn)
{
  MergedCaptures captures(datagramsOf(rig.captures));
  std::optional<Timestamp> start;
  for (Datagram datagram; captures.next(datagram);)
  {
    if (!start) start = datagram.received;
    if (datagram.received - *start >= longest || !goOn(captures.progress())) break;
    listener.add(datagram);
  }
  return captures.counters().damages;
}
}  // namespace scanloom
