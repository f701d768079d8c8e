#include "input/rig/internal/PacedCaptures.h"

#include "input/packets/CaptureWriter.h"
#include "liveRig.h"
#include "support/TemporaryFolder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace scanloom::paced_captures_unittest
{
namespace
{
std::deque<Datagram> receivedAt(double pace, const std::vector<Datagram>& sent)
{
  std::deque<Datagram> datagrams(sent.begin(), sent.end());
  const Timestamp first = datagrams.front().received;
  for (Datagram& datagram : datagrams)
    datagram.received = first + fromSeconds(pace * seconds(datagram.received - first));
  return datagrams;
}

TEST(PacedCaptures, paceIsToldWhereTimesOfReceptionAreInAWrongUnit)
{
  const LiveRig lidars(2);
  const std::vector<Datagram> sent = lidars.drive(1s);
  for (const double pace : {1.0, 1e3, 1e-3, 1e6})
    EXPECT_DOUBLE_EQ(receivePace(routesOf(lidars.rig), receivedAt(pace, sent)), pace);
}

TEST(PacedCaptures, paceIsOneForClocksThatAreFastWithoutReasonAndForPacketsThatWereWrittenAtOnce)
{
  const LiveRig lidars(1);
  const std::vector<Datagram> sent = lidars.drive(1s);
  for (const double pace : {0.0, 0.3, 4.0, 90.0})
    EXPECT_EQ(receivePace(routesOf(lidars.rig), receivedAt(pace, sent)), 1) << pace;
  EXPECT_EQ(receivePace(routesOf(lidars.rig), {}), 1);
}

TEST(PacedCaptures, aLongPauseBetweenTwoCapturesIsSaid)
{
  const TemporaryFolder folder;
  LiveRig lidars(1);
  for (const Timestamp begin : {Timestamp{1000s}, Timestamp{1060s}})
  {
    lidars.rig.captures.push_back(folder / fmt::format("{}.pcap", lidars.rig.captures.size()));
    CaptureWriter writer(lidars.rig.captures.back());
    for (const Datagram& datagram : lidars.drive(1s, begin)) writer.write(datagram);
  }
  PacedCaptures captures(lidars.rig);
  for (Datagram datagram; captures.next(datagram);)
    ;
  EXPECT_THAT(captures.takeWarnings(),
              testing::Contains(testing::HasSubstr("no packet for 59 s between two captures")));
}
}  // namespace
}  // namespace scanloom::paced_captures_unittest
