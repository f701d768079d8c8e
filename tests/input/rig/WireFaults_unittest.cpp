/** Faults of the network and of sensors, sent over the loopback interface: live, and from the capture made of it. */
#include "liveRig.h"
#include "support/TemporaryFolder.h"

#include <ostream>

namespace scanloom::wire_faults_unittest
{
namespace
{
using Datagrams = std::vector<Datagram>;

constexpr std::uint64_t kBlocks = 8;  // of a FakeLidar's packet
constexpr std::uint64_t kNotLost = 0;

bool isOfSecond(const LiveRig& lidars, const Datagram& datagram)
{
  return datagram.destination_port == lidars.rig.addresses[1].lidar_port;
}

template <typename Condition>
std::uint64_t eraseWhere(Datagrams& datagrams, Condition&& condition)
{
  const auto end = std::remove_if(datagrams.begin(), datagrams.end(), condition);
  const auto erased = static_cast<std::uint64_t>(datagrams.end() - end);
  datagrams.erase(end, datagrams.end());
  return erased;
}

/** Changes what the second lidar sends and returns how many of its packets the batcher must miss. */
struct WireFault
{
  const char* name;
  std::uint64_t (*happen)(const LiveRig&, Datagrams&);
  std::uint64_t LidarCounters::*counted;  // must show it, where one counter does
};
std::ostream& operator<<(std::ostream& os, const WireFault& fault) { return os << fault.name; }

std::uint64_t silence(const LiveRig& lidars, Datagrams& datagrams)
{
  const Timestamp begin = datagrams.front().received + 500ms;
  return eraseWhere(datagrams, [&](const Datagram& d)
                    { return isOfSecond(lidars, d) && d.received > begin && d.received < begin + 400ms; });
}

std::uint64_t loss(const LiveRig& lidars, Datagrams& datagrams)
{
  int n = 0;
  return eraseWhere(datagrams, [&](const Datagram& d) { return isOfSecond(lidars, d) && ++n % 5 == 3; });
}

std::uint64_t reordering(const LiveRig&, Datagrams& datagrams)
{
  for (std::size_t i = 10; i + 4 < datagrams.size(); i += 10)
    std::swap(datagrams[i].payload, datagrams[i + 2].payload);  // both are the same lidar's
  return kNotLost;
}

std::uint64_t repetition(const LiveRig& lidars, Datagrams& datagrams)
{
  Datagrams repeated;
  for (const Datagram& datagram : datagrams)
  {
    repeated.push_back(datagram);
    if (isOfSecond(lidars, datagram)) repeated.push_back(datagram);
  }
  datagrams = std::move(repeated);
  return kNotLost;
}

std::uint64_t truncation(const LiveRig& lidars, Datagrams& datagrams)
{
  std::uint64_t damaged = 0;
  for (std::size_t i = 20; i + 20 < datagrams.size(); i += 9)
    if (isOfSecond(lidars, datagrams[i]))
    {
      datagrams[i].payload.resize(i);
      ++damaged;
    }
  return damaged;
}

using WireFaults = testing::TestWithParam<WireFault>;
}  // namespace

TEST_P(WireFaults, areCountedHarmNobodyElseAndComeOutOfTheCaptureToTheBit)
{
  const TemporaryFolder folder;
  LiveRig lidars(2);
  lidars.rig.live.capture = folder / "live.pcap";
  Datagrams datagrams = lidars.drive(1500ms);
  const std::uint64_t of_each = datagrams.size() / 2;
  const std::uint64_t missed = GetParam().happen(lidars, datagrams);

  std::vector<SensorEvent> events;
  RigAccount account;
  {
    RigLive live(lidars.rig);
    events = sendAndRead(datagrams, live);
    account = live.account();
  }

  const LidarCounters &healthy = account.lidars[0].counters, &ill = account.lidars[1].counters;
  EXPECT_EQ(healthy.emitted + healthy.before_start, of_each * kBlocks);
  EXPECT_EQ(ill.lost, missed * kBlocks);
  EXPECT_EQ(ill.emitted + ill.before_start, (of_each - missed) * kBlocks);
  EXPECT_GT(ill.*GetParam().counted, 0u);

  expectTheSame(events, replayOf(lidars.rig, folder / "live.pcap"));
}

INSTANTIATE_TEST_SUITE_P(OnLoopback, WireFaults,
                         testing::Values(WireFault{"F1_silence", silence, &LidarCounters::lost},
                                         WireFault{"F4_loss", loss, &LidarCounters::lost},
                                         WireFault{"F5_reordering", reordering, &LidarCounters::emitted},
                                         WireFault{"F6_repetition", repetition, &LidarCounters::duplicate},
                                         WireFault{"F7_truncation", truncation, &LidarCounters::malformed_packets}),
                         [](const auto& fault) { return std::string(fault.param.name); });
}  // namespace scanloom::wire_faults_unittest
