#include "input/rig/internal/LiveCapture.h"

#include "input/packets/CaptureReader.h"
#include "support/FullDisk.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>

namespace scanloom::live_capture_unittest
{
namespace
{
using testing::HasSubstr;

Datagram datagramAt(Duration time, std::size_t size)
{
  return {Timestamp{1000s} + time, IpAddress::parse("10.0.0.1"), 4000, 7502, std::vector<std::uint8_t>(size, 7)};
}
}  // namespace

TEST(LiveCapture, followsNoLink)
{
  const TemporaryFolder folder;
  std::filesystem::create_symlink(folder / "victim", folder / "a.pcap");
  EXPECT_THROW(LiveCapture(folder / "a.pcap"), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "victim"));
}

TEST(LiveCapture, writesAllInOrderWithNanoseconds)
{
  const TemporaryFolder folder;
  {
    LiveCapture capture(folder / "a.pcap");
    for (int i = 0; i < 1000; ++i) capture.add(datagramAt(i * 1000001ns, static_cast<std::size_t>(1 + i)));
  }
  CaptureReader reader(folder / "a.pcap");
  Datagram datagram;
  for (int i = 0; i < 1000; ++i)
  {
    ASSERT_TRUE(reader.next(datagram));
    EXPECT_EQ(datagram.received, Timestamp{1000s} + i * 1000001ns);
    EXPECT_EQ(datagram.payload.size(), static_cast<std::size_t>(1 + i));
    EXPECT_EQ(datagram.destination_port, 7502);
  }
  EXPECT_FALSE(reader.next(datagram));
}

TEST(LiveCapture, dropsAndCountsWhatItsMemoryHasNoRoomFor)
{
  const TemporaryFolder folder;
  LiveCapture capture(folder / "a.pcap", 1000);
  capture.add(datagramAt(0s, 1001));
  capture.add(datagramAt(1s, 900));
  capture.close();

  EXPECT_EQ(capture.dropped(), 1u);
  CaptureReader reader(folder / "a.pcap");
  Datagram datagram;
  ASSERT_TRUE(reader.next(datagram));
  EXPECT_EQ(datagram.payload.size(), 900u);
}

TEST(LiveCapture, saysThatTheDiskIsFullAndKeepsNobodyWaiting)
{
  const TemporaryFolder folder;
  const FullDisk disk(100'000);
  LiveCapture capture(folder / "a.pcap");
  for (int i = 0; i < 100; ++i) capture.add(datagramAt(i * 1ms, 10'000));
  capture.close();

  EXPECT_THAT(capture.takeFailure(), HasSubstr("a.pcap: cannot be written"));
  EXPECT_GE(capture.dropped(), 80u);
}
}  // namespace scanloom::live_capture_unittest
