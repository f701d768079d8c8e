#include "input/packets/IpAddress.h"

#include <gtest/gtest.h>

namespace scanloom::ip_address_unittest
{
namespace
{
TEST(IpAddress, printsWhatItParsed)
{
  for (const char* text : {"10.5.6.101", "255.255.255.255", "0.0.0.0", "fe80::1", "2001:db8::ff00:42:8329", "::1"})
    EXPECT_EQ(IpAddress::parse(text).text(), text);
}

TEST(IpAddress, refusesWhatIsNoAddress)
{
  for (const char* text : {"", "left", "10.5.6", "10.5.6.256", "10.5.6.101:7502", "fe80::1%eth0", " 10.5.6.1"})
    EXPECT_THROW(IpAddress::parse(text), std::invalid_argument) << text;
}

TEST(IpAddress, comparesAnAddressMappedIntoIpV6AsTheSame)
{
  EXPECT_EQ(IpAddress::parse("::ffff:10.5.6.101"), IpAddress::parse("10.5.6.101"));
  EXPECT_NE(IpAddress::parse("10.5.6.102"), IpAddress::parse("10.5.6.101"));
}

TEST(IpAddress, hasTheBytesOfTheWire)
{
  const std::vector<std::uint8_t> wire{10, 5, 6, 101};
  const IpAddress address = IpAddress::fromBytes(wire);
  EXPECT_EQ(address.text(), "10.5.6.101");
  EXPECT_EQ(std::vector<std::uint8_t>(address.wire().begin(), address.wire().end()), wire);
  EXPECT_EQ(IpAddress::parse("fe80::1").wire().size(), 16u);
  EXPECT_THROW(IpAddress::fromBytes(Bytes(wire.data(), 3)), std::out_of_range);
}
}  // namespace
}  // namespace scanloom::ip_address_unittest
