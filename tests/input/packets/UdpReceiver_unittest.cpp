#include "input/packets/UdpReceiver.h"

#include "support/UdpSender.h"

#include <gmock/gmock.h>

#include <functional>
#include <thread>

namespace scanloom::udp_receiver_unittest
{
namespace
{
using testing::HasSubstr;

Datagram datagramTo(std::uint16_t port, const std::string& text, const std::string& source = "127.0.0.2")
{
  return {{}, IpAddress::parse(source), 0, port, {text.begin(), text.end()}};
}

struct Received
{
  std::uint16_t port;
  Timestamp stamp;
  IpAddress source;
  std::string text;
};

/** All datagrams in the rings; oldest first within a port. */
std::vector<Received> readAll(UdpReceiver& receiver)
{
  std::vector<Received> all;
  for (std::size_t i = 0; i < receiver.ports(); ++i)
    for (const DatagramRing::Slot* slot; (slot = receiver.ring(i).front()); receiver.ring(i).pop())
      all.push_back({receiver.port(i), slot->received, slot->source, {slot->bytes, slot->bytes + slot->size}});
  return all;
}

std::uint64_t arrived(const UdpReceiver& receiver)
{
  UdpCounters all;
  for (std::size_t i = 0; i < receiver.ports(); ++i) all += receiver.counters(i);
  return all.datagrams + all.filtered + all.truncated + all.dropped + all.kernel_drops;
}

/**
 * Waits until all datagrams `sent` have arrived, then ends the reception: on a busy machine the kernel passes a
 * datagram on some time after it was sent.
 */
void stopAndWait(UdpReceiver& receiver, std::uint64_t sent)
{
  for (int i = 0; i < 10'000 && arrived(receiver) < sent; ++i) std::this_thread::sleep_for(1ms);
  receiver.stop();
  while (!receiver.ended()) receiver.wait(100ms);
}

std::string complaintOf(const std::function<void()>& action)
{
  try
  {
    action();
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return "";
}

UdpReceiverOptions onPorts(const std::vector<UdpPort>& ports)
{
  UdpReceiverOptions options;
  options.ports = ports;
  return options;
}
}  // namespace

TEST(UdpReceiver, givesDatagramsOfSeveralPortsWithSender)
{
  UdpReceiver receiver(onPorts({{0}, {0}}));
  UdpSender sender;
  for (int i = 0; i < 100; ++i)
  {
    sender.send(datagramTo(receiver.port(0), "a" + std::to_string(i)));
    sender.send(datagramTo(receiver.port(1), "b" + std::to_string(i), "127.0.0.3"));
  }
  stopAndWait(receiver, 200);

  const auto all = readAll(receiver);
  ASSERT_EQ(all.size(), 200u);
  for (std::size_t i = 0; i < 100; ++i)
  {
    EXPECT_EQ(all[i].text, "a" + std::to_string(i));
    EXPECT_EQ(all[100 + i].text, "b" + std::to_string(i));
    EXPECT_EQ(all[i].source.text(), "127.0.0.2");
    EXPECT_EQ(all[100 + i].source.text(), "127.0.0.3");
  }
}

TEST(UdpReceiver, stampsAreTheTimesOfArrivalInOneOrderOverAllPorts)
{
  UdpReceiver receiver(onPorts({{0}, {0}}));
  UdpSender sender;
  std::this_thread::sleep_for(50ms);  // until the kernel stamps: it begins when the first socket asks, but not at once
  const Timestamp before{HostClocks::now().realtime};
  for (int i = 0; i < 20; ++i)
    for (std::size_t port : {0, 1})
    {
      sender.send(datagramTo(receiver.port(port), "x"));
      std::this_thread::sleep_for(2ms);
    }
  stopAndWait(receiver, 40);
  const Timestamp after{HostClocks::now().realtime};

  const auto all = readAll(receiver);
  ASSERT_EQ(all.size(), 40u);
  const Duration exactness = 1ms;  // of two clocks read one after the other (SteadyStamps)
  for (std::size_t i = 0; i < 20; ++i)
  {
    EXPECT_GE(all[i].stamp, before - exactness);
    EXPECT_LE(all[20 + i].stamp, after + exactness);
    EXPECT_LT(all[i].stamp, all[20 + i].stamp) << i;
    if (i > 0)
    {
      EXPECT_LT(all[20 + i - 1].stamp, all[i].stamp) << i;
    }
  }
}

TEST(UdpReceiver, receivesIpv4AndIpv6OnOnePort)
{
  UdpReceiver receiver(onPorts({{0}}));
  UdpSender sender;
  sender.send(datagramTo(receiver.port(0), "four"));
  sender.send(datagramTo(receiver.port(0), "six", "::1"));
  stopAndWait(receiver, 2);

  const auto all = readAll(receiver);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].source.text(), "127.0.0.2");
  EXPECT_EQ(all[1].source.text(), "::1");
}

TEST(UdpReceiver, takesTheLongestDatagramThatUdpCarries)
{
  UdpReceiver receiver(onPorts({{0}}));
  const std::string longest(65507, 'x');
  UdpSender().send(datagramTo(receiver.port(0), longest));
  stopAndWait(receiver, 1);

  const auto all = readAll(receiver);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].text, longest);
}

TEST(UdpReceiver, refusesOtherSourcesAndCountsThem)
{
  UdpReceiver receiver(onPorts({{0, {IpAddress::parse("127.0.0.2")}}}));
  UdpSender sender;
  for (int i = 0; i < 50; ++i)
  {
    sender.send(datagramTo(receiver.port(0), "good"));
    sender.send(datagramTo(receiver.port(0), "foreign", "127.0.0.9"));
  }
  stopAndWait(receiver, 100);

  EXPECT_EQ(readAll(receiver).size(), 50u);
  EXPECT_EQ(receiver.counters(0).datagrams, 50u);
  EXPECT_EQ(receiver.counters(0).filtered, 50u);
}

TEST(UdpReceiver, countsWhatIsLongerThanItsSlots)
{
  UdpReceiverOptions options = onPorts({{0}});
  options.slot_bytes = 100;
  UdpReceiver receiver(options);
  UdpSender sender;
  sender.send(datagramTo(receiver.port(0), std::string(100, 'a')));
  sender.send(datagramTo(receiver.port(0), std::string(101, 'b')));
  sender.send(datagramTo(receiver.port(0), std::string(99, 'c')));
  stopAndWait(receiver, 3);

  EXPECT_EQ(readAll(receiver).size(), 2u);
  EXPECT_EQ(receiver.counters(0).truncated, 1u);
}

TEST(UdpReceiver, dropsAndCountsWhatAReaderWhoDoesNothingLeavesNoRoomFor)
{
  UdpReceiver receiver(onPorts({{0, {}, 64}}));
  UdpSender sender;
  for (int i = 0; i < 1000; ++i)
  {
    sender.send(datagramTo(receiver.port(0), std::to_string(i)));
    if (i % 100 == 0) std::this_thread::sleep_for(1ms);
  }
  stopAndWait(receiver, 1000);

  const UdpCounters counters = receiver.counters(0);
  EXPECT_EQ(counters.datagrams, 64u);
  EXPECT_EQ(counters.dropped, 1000u - 64u);
  EXPECT_EQ(counters.kernel_drops, 0u) << "the thread went on receiving";
  EXPECT_EQ(readAll(receiver).size(), 64u);
}

TEST(UdpReceiver, theKernelsDropCounterIsTheMeasuredLoss)
{
  constexpr std::uint64_t kSent = 20'000;
  UdpReceiverOptions options = onPorts({{0, {}, 100'000}});
  options.receive_buffer = 1;  // the kernel's least
  UdpReceiver receiver(options);
  UdpSender sender;
  for (std::uint64_t i = 0; i < kSent; ++i) sender.send(datagramTo(receiver.port(0), std::string(500, 'x')));
  stopAndWait(receiver, kSent);

  const UdpCounters counters = receiver.counters(0);
  EXPECT_GT(counters.kernel_drops, 0u);
  EXPECT_EQ(counters.datagrams + counters.kernel_drops, kSent);
}

TEST(UdpReceiver, namesABufferThatWasNotGranted)
{
  UdpReceiverOptions options = onPorts({{0}});
  EXPECT_EQ(UdpSocket({0, {}, 100'000}).bufferWarning(), "");

  options.receive_buffer = 3'000'000'000;  // the kernel's counter ends before that
  const UdpReceiver receiver(options);
  ASSERT_EQ(receiver.warnings().size(), 1u);
  EXPECT_THAT(receiver.warnings()[0], HasSubstr("sysctl -w net.core.rmem_max=3000000000"));
}

TEST(UdpReceiver, timeGoesOnWithoutDatagrams)
{
  UdpReceiver receiver(onPorts({{0}}));
  receiver.wait(100ms);
  const Timestamp once = receiver.drainedUntil();
  std::this_thread::sleep_for(20ms);
  const Timestamp later = receiver.drainedUntil();

  EXPECT_GE(later - once, 10ms);
  EXPECT_LE(later, HostClocks::now().realtime);
}

TEST(UdpReceiver, saysWhoseAPortIsThatIsTaken)
{
  const UdpReceiver first(onPorts({{0}}));
  const std::string complaint = complaintOf([&] { UdpReceiver(onPorts({{first.port(0)}})); });

  EXPECT_THAT(complaint, HasSubstr("UDP port " + std::to_string(first.port(0))));
  EXPECT_THAT(complaint, HasSubstr("ss -lunp"));
}

TEST(UdpReceiver, saysWhichAddressIsNoneOfThisComputer)
{
  UdpReceiverOptions options = onPorts({{0}});
  options.bind_address = IpAddress::parse("192.0.2.77");  // TEST-NET-1: nobody's

  EXPECT_THAT(complaintOf([&] { UdpReceiver receiver(options); }),
              HasSubstr("192.0.2.77 is no address of this computer: 'ip address' lists them"));
}

TEST(UdpReceiver, receivesOnOneAddressAlone)
{
  UdpReceiverOptions options = onPorts({{0}});
  options.bind_address = IpAddress::parse("127.0.0.1");
  UdpReceiver receiver(options);
  UdpSender().send(datagramTo(receiver.port(0), "here"));
  stopAndWait(receiver, 1);
  EXPECT_EQ(readAll(receiver).size(), 1u);
}

TEST(UdpReceiver, wantsAPort) { EXPECT_THROW(UdpReceiver(onPorts({})), std::invalid_argument); }
}  // namespace scanloom::udp_receiver_unittest
