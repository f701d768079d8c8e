#include "diagnosis/Listening.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "diagnosis/internal/RigExamination.h"
#include "input/rig/liveRig.h"

namespace scanloom::listening_unittest
{
namespace
{
/** Listens until all is sent, however long a busy machine takes. */
RigEvidence heard(const Rig& rig, const std::vector<Datagram>& datagrams)
{
  RigListener listener(rig, true);
  std::atomic<bool> sent{false};
  std::thread sender(
      [&]
      {
        for (const auto& address : rig.addresses)  // opened one after the other
          while (!isReceivedOn(address.lidar_port)) std::this_thread::sleep_for(1ms);
        UdpSender().replay(datagrams);
        sent = true;
      });
  listenLive(rig, 1h, listener, [&] { return !sent; });
  sender.join();
  return listener.finish();
}
}  // namespace

TEST(Listening, hearsWhatIsSentAndMissesWhatIsNot)
{
  const LiveRig live(2);
  std::vector<Datagram> datagrams = live.drive(1s);
  const std::size_t of_one = datagrams.size() / 2;
  const auto lost =
      std::find_if(datagrams.begin() + 50, datagrams.end(),
                   [&](const Datagram& d) { return d.destination_port == live.rig.addresses[1].lidar_port; });
  datagrams.erase(lost);

  const RigExamination seen = examine(heard(live.rig, datagrams));
  EXPECT_EQ(seen.lidars[0].delivery.packets, of_one);
  EXPECT_EQ(seen.lidars[0].delivery.loss.packets, 0u);
  EXPECT_EQ(seen.lidars[1].delivery.packets, of_one - 1);
  EXPECT_EQ(seen.lidars[1].delivery.loss.packets, 1u);
  ASSERT_TRUE(seen.sockets);
  EXPECT_EQ(seen.sockets->counters.datagrams, datagrams.size());
  EXPECT_EQ(seen.sockets->counters.kernel_drops, 0u);
}

TEST(Listening, endsWhenToldToOrWhenItsTimeIsOver)
{
  const LiveRig live(1);
  RigListener listener(live.rig, true);
  listenLive(live.rig, 1h, listener, [] { return false; });
  listenLive(live.rig, 10ms, listener, [] { return true; });
  EXPECT_TRUE(listener.finish().lidars.front().packets.empty());
}
}  // namespace scanloom::listening_unittest
