#include "input/packets/CaptureWriter.h"

#include "HandmadeCapture.h"
#include "input/packets/CaptureReader.h"
#include "support/stockTool.h"

#include <gmock/gmock.h>

namespace scanloom::capture_writer_unittest
{
namespace
{
Datagram datagram(const std::string& source, std::size_t size, std::int64_t received = 1750000000123456789)
{
  return {fromNanoseconds(received), IpAddress::parse(source), 40001, 7502, content(size, static_cast<unsigned>(size))};
}

/** Odd lengths, sizes around the MTU and of lidar packets; one of zeros, whose checksum would be 0. */
std::vector<Datagram> datagramsOfAllKinds()
{
  std::vector<Datagram> all;
  std::int64_t t = 1750000000123456789;
  for (const char* source : {"192.168.1.10", "fe80::1"})
    for (const std::size_t size : {0, 1, 48, 1473, 8448, 24832, 65507})
      all.push_back(datagram(source, size, t += 1'000'001));
  return all;
}

TEST(CaptureWriter, writesWhatTheReaderReadsBack)
{
  const HandmadeCapture folder;
  const auto sent = datagramsOfAllKinds();
  CaptureWriter writer(folder.folder() / "a.pcap");
  for (const Datagram& d : sent) writer.write(d);
  writer.close();

  CaptureReader reader(folder.folder() / "a.pcap");
  Datagram read;
  for (const Datagram& d : sent)
  {
    ASSERT_TRUE(reader.next(read));
    EXPECT_EQ(read.received, d.received);
    EXPECT_EQ(read.source, d.source);
    EXPECT_EQ(read.source_port, d.source_port);
    EXPECT_EQ(read.destination_port, d.destination_port);
    EXPECT_EQ(read.payload, d.payload);
  }
  EXPECT_FALSE(reader.next(read));
}

TEST(CaptureWriter, satisfiesTsharkInChecksumsLengthsAndNanoseconds)
{
  SCANLOOM_NEEDS_TOOL("tshark");
  const HandmadeCapture folder;
  const auto path = folder.folder() / "a.pcap";
  const auto sent = datagramsOfAllKinds();
  CaptureWriter writer(path);
  for (const Datagram& d : sent) writer.write(d);
  writer.close();

  const auto lines =
      linesOf("tshark -n -r " + path.string() +
              " -o ip.check_checksum:TRUE -o udp.check_checksum:TRUE -T fields -E separator=, -e frame.time_epoch"
              " -e ip.checksum.status -e udp.checksum.status -e udp.length -e udp.dstport -e _ws.malformed");
  ASSERT_EQ(lines.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i)
  {
    const std::string number = std::to_string(nanoseconds(sent[i].received));
    EXPECT_EQ(lines[i], number.substr(0, 10) + "." + number.substr(10) + "," + (sent[i].source.isV4() ? "1" : "") +
                            ",1," + std::to_string(sent[i].payload.size() + 8) + ",7502,");
  }
}

TEST(CaptureWriter, refusesWhatNoDatagramAndNoCaptureCanHold)
{
  const HandmadeCapture folder;
  CaptureWriter writer(folder.folder() / "a.pcap");
  EXPECT_THROW(writer.write(datagram("10.0.0.1", kLargestUdpPayload + 1)), std::invalid_argument);
  EXPECT_THROW(writer.write(datagram("10.0.0.1", 8, -1)), std::invalid_argument);
  EXPECT_THROW(writer.write(datagram("10.0.0.1", 8, (std::int64_t{1} << 32) * 1'000'000'000)), std::invalid_argument);
  EXPECT_THROW(CaptureWriter(folder.folder() / "none" / "a.pcap"), std::runtime_error);
}

TEST(CaptureWriter, hasEverythingInTheFileAfterAFlush)
{
  const HandmadeCapture folder;
  CaptureWriter writer(folder.folder() / "a.pcap");
  writer.write(datagram("10.0.0.1", 100));
  writer.flush();
  CaptureReader reader(folder.folder() / "a.pcap");
  Datagram read;
  EXPECT_TRUE(reader.next(read));
  EXPECT_FALSE(reader.counters().truncated);
}

TEST(CaptureWriter, saysThatTheDiskIsFull)
{
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_THROW(
      {
        CaptureWriter writer("/dev/full");
        for (int i = 0; i < 100; ++i) writer.write(datagram("10.0.0.1", 65000));
        writer.close();
      },
      std::runtime_error);
}
}  // namespace
}  // namespace scanloom::capture_writer_unittest
