#include "rig/LiveCapture.h"

#include "packets/CaptureReader.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>

namespace scanloom
{
namespace
{
using testing::HasSubstr;

Datagram datagramAt(Duration time, std::size_t size)
{
  return {Timestamp{1000s} + time, IpAddress::parse("10.0.0.1"), 4000, 7502, std::vector<std::uint8_t>(size, 7)};
}

/** No file of this process may be longer, as on a full disk. */
class FullDisk
{
 public:
  explicit FullDisk(rlim_t bytes) : previous_(signal(SIGXFSZ, SIG_IGN))
  {
    getrlimit(RLIMIT_FSIZE, &limits_);
    const rlimit few{bytes, limits_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &few);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk()
  {
    setrlimit(RLIMIT_FSIZE, &limits_);
    signal(SIGXFSZ, previous_);
  }

 private:
  void (*previous_)(int);
  rlimit limits_{};
};
}  // namespace

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
}  // namespace scanloom
