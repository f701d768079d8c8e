#include "input/packets/SensorAddress.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "input/packets/SocketAddress.h"

namespace scanloom::sensor_address_unittest
{
TEST(SensorAddress, takesAnAddressWithAndWithoutAPort)
{
  EXPECT_EQ(SensorAddress::parse("10.5.6.101").port, 80);
  EXPECT_EQ(SensorAddress::parse("10.5.6.101:8080").port, 8080);
  EXPECT_EQ(SensorAddress::parse("10.5.6.101:8080").ip, IpAddress::parse("10.5.6.101"));
  EXPECT_EQ(SensorAddress::parse("fe80::1").ip, IpAddress::parse("fe80::1"));
  EXPECT_EQ(SensorAddress::parse("[fe80::1]:8080").port, 8080);
  EXPECT_EQ(SensorAddress::parse("[fe80::1]:8080").ip, IpAddress::parse("fe80::1"));
}

TEST(SensorAddress, isWrittenAsItIsRead)
{
  for (const char* text : {"10.5.6.101", "10.5.6.101:8080", "fe80::1", "[fe80::1]:8080"})
    EXPECT_EQ(SensorAddress::parse(text).text(), text);
}

TEST(SensorAddress, refusesEverythingElse)
{
  for (const char* text : {"", "os-992146000760.local", "10.5.6.101:", "10.5.6.101:0", "10.5.6.101:65536",
                           "10.5.6.101:80x", "10.5.6.101:-1", "[fe80::1", "[fe80::1]", ":80", "http://10.5.6.101"})
    EXPECT_THROW(SensorAddress::parse(text), std::invalid_argument) << text;
}

TEST(SocketAddress, givesAddressAndPortBack)
{
  for (const char* text : {"10.5.6.101", "fe80::1"})
  {
    const SocketAddress address = SocketAddress::of(IpAddress::parse(text), 7502);
    EXPECT_EQ(address.ip(), IpAddress::parse(text));
    EXPECT_EQ(address.port(), 7502);
  }
}

TEST(SocketAddress, aSensorOnThisComputerIsReachedFromThisComputer)
{
  EXPECT_EQ(ownAddressTowards(IpAddress::parse("127.0.0.1")), IpAddress::parse("127.0.0.1"));
}
}  // namespace scanloom::sensor_address_unittest
