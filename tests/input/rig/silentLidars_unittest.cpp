#include "input/rig/silentLidars.h"

#include <gmock/gmock.h>

namespace scanloom::silent_lidars_unittest
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;

LidarAccount lidar(const std::string& name, std::uint64_t emitted)
{
  LidarAccount account;
  account.name = name;
  account.counters.emitted = emitted;
  return account;
}

TEST(SilentLidars, areNoneWhereEveryLidarIsInTheScansWhoeverElseSends)
{
  RigAccount account;
  account.lidars = {lidar("left", 1), lidar("right", 2)};
  account.unmatched[{7400, IpAddress::parse("10.0.0.7")}] = 5;
  EXPECT_TRUE(silentLidars(account).empty());
}

TEST(SilentLidars, areNamedWithWhatBecameOfTheirPacketsAndWithTheStrangers)
{
  RigAccount account;
  account.lidars = {lidar("left", 1), lidar("right", 0), lidar("front", 0)};
  account.lidars[1].counters.malformed_packets = 7;
  account.unmatched[{2368, IpAddress::parse("192.168.1.200")}] = 84;
  account.unmatched[{8308, IpAddress::parse("192.168.1.200")}] = 16;
  EXPECT_THAT(silentLidars(account),
              ElementsAre(testing::AllOf(HasSubstr("'right'"), HasSubstr("7 packets of another format")),
                          testing::AllOf(HasSubstr("'front'"), HasSubstr("no packet of it came")),
                          HasSubstr("84 datagrams from 192.168.1.200 to port 2368"),
                          HasSubstr("16 datagrams from 192.168.1.200 to port 8308")));
}
}  // namespace
}  // namespace scanloom::silent_lidars_unittest
