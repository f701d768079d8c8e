#include "input/rig/internal/ReceivePace.h"

#include "liveRig.h"

#include <gtest/gtest.h>

namespace scanloom::receive_pace_unittest
{
namespace
{
std::vector<Datagram> receivedAt(double pace, std::vector<Datagram> datagrams)
{
  const Timestamp first = datagrams.front().received;
  for (Datagram& datagram : datagrams)
    datagram.received = first + fromSeconds(pace * seconds(datagram.received - first));
  return datagrams;
}

TEST(ReceivePace, isToldWhereTimesOfReceptionAreInAWrongUnit)
{
  const LiveRig lidars(2);
  const std::vector<Datagram> sent = lidars.drive(1s);
  for (const double pace : {1.0, 1e3, 1e-3, 1e6})
    EXPECT_DOUBLE_EQ(receivePace(routesOf(lidars.rig), receivedAt(pace, sent)), pace);
}

TEST(ReceivePace, isOneForClocksThatAreFastWithoutReasonAndForPacketsThatWereWrittenAtOnce)
{
  const LiveRig lidars(1);
  const std::vector<Datagram> sent = lidars.drive(1s);
  for (const double pace : {0.0, 0.3, 4.0, 90.0})
    EXPECT_EQ(receivePace(routesOf(lidars.rig), receivedAt(pace, sent)), 1) << pace;
  EXPECT_EQ(receivePace(routesOf(lidars.rig), {}), 1);
}
}  // namespace
}  // namespace scanloom::receive_pace_unittest
