#include "input/rig/internal/PacedCaptures.h"

#include "liveRig.h"

#include <gtest/gtest.h>

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
}  // namespace
}  // namespace scanloom::paced_captures_unittest
