#include "input/packets/CaptureReader.h"

#include "HandmadeCapture.h"
#include "support/TemporaryFolder.h"
#include "support/runProgram.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <functional>

namespace scanloom::capture_reader_unittest
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;

struct Contents
{
  std::vector<Datagram> datagrams;
  CaptureCounters counters;
};

Contents read(const std::filesystem::path& path)
{
  CaptureReader reader(path);
  Contents contents;
  for (Datagram datagram; reader.next(datagram);) contents.datagrams.push_back(datagram);
  contents.counters = reader.counters();
  return contents;
}

std::vector<ByteVector> payloads(const Contents& contents)
{
  std::vector<ByteVector> all;
  for (const Datagram& datagram : contents.datagrams) all.push_back(datagram.payload);
  return all;
}

std::string errorOf(const std::filesystem::path& path)
{
  try
  {
    CaptureReader{path};
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  return "no error";
}

const ByteVector kPayload = content(100);
const ByteVector kPacket = ipv4Packet(udp(7502, kPayload));

TEST(CaptureReader, tellsTimeToTheNanosecondAndWhoSentWhatWhere)
{
  HandmadeCapture capture;
  capture.add(ethernet(kPacket), 1750000000s + 123456789ns);
  const Contents contents = read(capture.file());

  ASSERT_EQ(contents.datagrams.size(), 1u);
  const Datagram& datagram = contents.datagrams[0];
  EXPECT_EQ(nanoseconds(datagram.received), 1750000000123456789);
  EXPECT_EQ(datagram.source.text(), "10.0.0.1");
  EXPECT_EQ(datagram.source_port, 4000);
  EXPECT_EQ(datagram.destination_port, 7502);
  EXPECT_EQ(datagram.payload, kPayload);
}

TEST(CaptureReader, readsGzipAndZstdUpToACutThatItTells)
{
  HandmadeCapture capture;
  for (int i = 0; i < 5000; ++i) capture.add(ethernet(ipv4Packet(udp(7502, content(100 + i % 7)))));
  const TemporaryFolder folder;
  std::filesystem::copy(capture.file(), folder / "plain.pcap");
  ASSERT_EQ(runProgram(fmt::format("cd {} && gzip -k plain.pcap && zstd -q plain.pcap && head -c 2000 plain.pcap.gz > "
                                   "cut.pcap.gz",
                                   folder.path().string()))
                .status,
            0);
  const std::vector<ByteVector> plain = payloads(read(folder / "plain.pcap"));
  EXPECT_EQ(payloads(read(folder / "plain.pcap.gz")), plain);
  EXPECT_EQ(payloads(read(folder / "plain.pcap.zst")), plain);

  const Contents cut = read(folder / "cut.pcap.gz");
  EXPECT_THAT(cut.counters.damages, ElementsAre(HasSubstr("cut")));
  EXPECT_LT(cut.datagrams.size(), plain.size());
  EXPECT_EQ(payloads(cut),
            std::vector<ByteVector>(plain.begin(), plain.begin() + static_cast<long>(cut.datagrams.size())));
}

struct Framing
{
  const char* name;
  std::uint32_t link_type;  // as the file numbers it
  ByteVector header;
  ByteVector packet = kPacket;
};

class CaptureReaderFraming : public testing::TestWithParam<Framing>
{
};

TEST_P(CaptureReaderFraming, isTakenOff)
{
  HandmadeCapture capture(GetParam().link_type);
  capture.add(GetParam().header + GetParam().packet);
  EXPECT_THAT(payloads(read(capture.file())), ElementsAre(kPayload));
}

const ByteVector kMacs(12, 0x02);
INSTANTIATE_TEST_SUITE_P(
    All, CaptureReaderFraming,
    testing::Values(Framing{"Ethernet", 1, kMacs + be16(0x0800)},
                    Framing{"EthernetIpV6", 1, kMacs + be16(0x86dd), ipv6Packet(udp(7502, kPayload))},
                    Framing{"Vlan", 1, kMacs + be16(0x8100) + be16(42) + be16(0x0800)},
                    Framing{"QinQ", 1, kMacs + be16(0x88a8) + be16(7) + be16(0x8100) + be16(42) + be16(0x0800)},
                    Framing{"CookedSll", 113, be16(0) + be16(1) + be16(6) + ByteVector(8, 2) + be16(0x0800)},
                    Framing{"CookedSllWithVlan", 113,
                            be16(0) + be16(1) + be16(6) + ByteVector(8, 2) + be16(0x8100) + be16(42) + be16(0x0800)},
                    Framing{"CookedSll2", 276,
                            be16(0x0800) + be16(0) + be32(3) + be16(1) + ByteVector{0, 6} + ByteVector(8, 2)},
                    Framing{"RawIp", 101, {}}, Framing{"RawIpV6", 101, {}, ipv6Packet(udp(7502, kPayload))},
                    Framing{"LinkTypeIpV4", 228, {}}, Framing{"LinkTypeIpV6", 229, {}, ipv6Packet(udp(7502, kPayload))},
                    Framing{"LoopbackOfThisMachine", 0, {2, 0, 0, 0}},
                    Framing{"LoopbackOfOtherByteOrder", 0, {0, 0, 0, 30}, ipv6Packet(udp(7502, kPayload))},
                    Framing{"OpenBsdLoopback", 108, be32(2)}),
    [](const auto& test) { return test.param.name; });

TEST(CaptureReader, skipsTheHeadersThatIpV6PutsBeforeUdp)
{
  const ByteVector hop_by_hop{60, 0, 1, 4, 0, 0, 0, 0},
      destination_options{17, 1, 1, 12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  HandmadeCapture capture;
  capture.add(ethernet(0x86dd, ipv6Packet(hop_by_hop + destination_options + udp(7502, kPayload), 0)));
  EXPECT_THAT(payloads(read(capture.file())), ElementsAre(kPayload));
}

TEST(CaptureReader, cutsThePaddingOfShortEthernetFrames)
{
  HandmadeCapture capture;
  capture.add(ethernet(ipv4Packet(udp(7503, {1, 2, 3}))) + ByteVector(15, 0));
  EXPECT_THAT(payloads(read(capture.file())), ElementsAre(ByteVector{1, 2, 3}));
}

TEST(CaptureReader, readsPacketsWithoutALengthAsSplittingNetworkCardsShowThem)
{
  ByteVector packet = kPacket;
  packet[2] = packet[3] = 0;
  HandmadeCapture capture;
  capture.add(ethernet(packet));
  EXPECT_THAT(payloads(read(capture.file())), ElementsAre(kPayload));
}

TEST(CaptureReader, joinsFragmentsOfTwoSendersThatArriveMixedAndInReverse)
{
  const ByteVector a = content(4000, 1), b = content(3000, 2);
  auto of_a = ipv4Fragments(udp(7502, a), 1480, 9), of_b = ipv4Fragments(udp(7502, b), 1480, 9);
  for (ByteVector& packet : of_b) packet[15] = 77;  // another source, the same id
  HandmadeCapture capture;
  capture.add(ethernet(of_a[2]), 1s).add(ethernet(of_b[0]), 2us + 1s).add(ethernet(of_a[1]), 4us + 1s);
  capture.add(ethernet(of_b[2]), 5us + 1s).add(ethernet(of_a[0]), 6us + 1s).add(ethernet(of_b[1]), 7us + 1s);
  const Contents contents = read(capture.file());

  EXPECT_THAT(payloads(contents), ElementsAre(a, b));
  EXPECT_EQ(contents.datagrams[0].received, Timestamp{1s + 6us});
  EXPECT_EQ(contents.datagrams[1].source.text(), "10.0.0.77");
  EXPECT_EQ(contents.counters.fragments_joined, 2u);
  EXPECT_EQ(contents.counters.fragments_expired, 0u);
}

TEST(CaptureReader, joinsFragmentsOfIpV6)
{
  const ByteVector payload = content(3000), datagram = udp(7502, payload);
  const auto cut = [&](long begin, long end) { return ByteVector(datagram.begin() + begin, datagram.begin() + end); };
  HandmadeCapture capture;
  capture.add(ethernet(0x86dd, ipv6Fragment(cut(0, 1448), {99, 0, true})));
  capture.add(ethernet(0x86dd, ipv6Fragment(cut(2896, 3008), {99, 2896, false})));
  capture.add(ethernet(0x86dd, ipv6Fragment(cut(1448, 2896), {99, 1448, true})));
  capture.add(ethernet(0x86dd, ipv6Fragment(udp(7503, kPayload), {100, 0, false})));  // "atomic": whole in one fragment
  EXPECT_THAT(payloads(read(capture.file())), ElementsAre(payload, kPayload));
}

TEST(CaptureReader, countsWhatIsNoUdp)
{
  HandmadeCapture capture;
  capture.add(ethernet(0x0806, ByteVector(28, 0)));                 // ARP
  capture.add(ethernet(ipv4Packet(content(40), {}, 6)));            // TCP
  capture.add(ethernet(ipv4Packet(content(40), {5, 0, true}, 1)));  // a fragment of ICMP
  capture.add(ethernet(kPacket));
  const Contents contents = read(capture.file());

  EXPECT_EQ(contents.counters.not_udp, 3u);
  EXPECT_EQ(contents.counters.datagrams, 1u);
  EXPECT_EQ(contents.counters.fragments_expired, 0u);
  EXPECT_EQ(contents.counters.records, 4u);
}

TEST(CaptureReader, refusesLengthsThatContradictTheBytes)
{
  ByteVector udp_too_long = kPacket, udp_too_short = kPacket, both_too_long = kPacket, header_too_short = kPacket;
  udp_too_long[25] = 200;
  udp_too_short[25] = 7;
  both_too_long[3] = both_too_long[25] = 200;
  header_too_short[0] = 0x44;
  HandmadeCapture capture;
  for (const auto& packet : {udp_too_long, udp_too_short, both_too_long, header_too_short})
    capture.add(ethernet(packet));
  capture.add(ethernet(0x0800, {0x95})).add({1, 2, 3}).add(ethernet(0x8100, {0}));
  const Contents contents = read(capture.file());

  EXPECT_EQ(contents.counters.malformed, 7u);
  EXPECT_TRUE(contents.datagrams.empty());
}

TEST(CaptureReader, goesByTheLengthOfUdpWhereThatOfIpIsTooLong)
{
  ByteVector old_position = kPacket;  // 1234 bytes, as old VLP-16s say
  old_position[2] = 1234 >> 8;
  old_position[3] = 1234 & 0xff;
  HandmadeCapture capture;
  capture.add(ethernet(old_position));
  EXPECT_THAT(payloads(read(capture.file())), ElementsAre(kPayload));
}

TEST(CaptureReader, countsFramesThatTheSnapLengthCut)
{
  HandmadeCapture capture;
  const ByteVector frame = ethernet(kPacket);
  capture.add(ByteVector(frame.begin(), frame.begin() + 96), 1s, frame.size());
  const Contents contents = read(capture.file());
  EXPECT_EQ(contents.counters.cut_short, 1u);
  EXPECT_TRUE(contents.datagrams.empty());
}

TEST(CaptureReader, deliversEverythingBeforeACutWhereverItIs)
{
  HandmadeCapture capture;
  std::vector<std::size_t> ends{capture.size()};
  for (unsigned i = 0; i < 3; ++i)
  {
    capture.add(ethernet(ipv4Packet(udp(7502, content(30, i)))));
    ends.push_back(capture.size());
  }
  for (std::size_t length = ends.front(); length <= capture.size(); ++length)
  {
    const Contents contents = read(capture.file(length));
    const auto whole = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), length) - ends.begin()) - 1;
    ASSERT_EQ(contents.datagrams.size(), whole) << length;
    ASSERT_EQ(contents.counters.truncated, ends[whole] != length) << length;
  }
}

TEST(CaptureReader, readsAnEmptyCapture)
{
  const Contents contents = read(HandmadeCapture().file());
  EXPECT_EQ(contents.counters.records, 0u);
  EXPECT_FALSE(contents.counters.truncated);
}

TEST(CaptureReader, saysWhereADamagedFileBreaksAndDeliversWhatWasBefore)
{
  HandmadeCapture capture;
  capture.add(ethernet(kPacket));
  const auto path = capture.file();
  std::ofstream(path, std::ios::binary | std::ios::app) << std::string(16, '\xff') << std::string(100, 'x');
  CaptureReader reader(path);
  Datagram datagram;

  EXPECT_TRUE(reader.next(datagram));
  for (int again = 0; again < 2; ++again)
  {
    EXPECT_FALSE(reader.next(datagram));
    ASSERT_EQ(reader.counters().damages.size(), 1u) << "an absurd length went unnoticed";
    EXPECT_THAT(reader.counters().damages[0], HasSubstr("damaged after record 1"));
  }
}

/** A pcapng file block by block; its bytes may be of a machine of the other order. */
class HandmadePcapng
{
 public:
  explicit HandmadePcapng(bool big_endian = false) : file_(path(), std::ios::binary), big_endian_(big_endian)
  {
    block(0x0A0D0D0A, {0x1A2B3C4D, 0x00000001, 0xFFFFFFFF, 0xFFFFFFFF});
  }
  HandmadePcapng& interface(std::uint16_t link_type, std::uint32_t snap_length)
  {
    return block(1, {big_endian_ ? std::uint32_t{link_type} << 16 : link_type, snap_length});
  }
  /** An enhanced packet block at a microsecond. */
  HandmadePcapng& packet(std::uint32_t interface, std::uint32_t microsecond, ByteVector frame)
  {
    const auto length = static_cast<std::uint32_t>(frame.size());
    frame.resize((frame.size() + 3) / 4 * 4);
    return block(6, {interface, 0, microsecond, length, length}, frame);
  }
  HandmadePcapng& block(std::uint32_t type, const std::vector<std::uint32_t>& body, const ByteVector& bytes = {})
  {
    const auto length = static_cast<std::uint32_t>(4 * body.size() + bytes.size() + 12);
    write(type);
    write(length);
    for (const std::uint32_t word : body) write(word);
    file_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    write(length);
    return *this;
  }
  Contents contents()
  {
    file_.flush();
    return read(path());
  }
  std::filesystem::path path() const { return folder_ / "a.pcapng"; }

 private:
  void write(std::uint32_t word)
  {
    if (big_endian_) word = __builtin_bswap32(word);
    file_.write(reinterpret_cast<const char*>(&word), sizeof word);
  }

  TemporaryFolder folder_;
  std::ofstream file_;
  bool big_endian_;
};

TEST(CaptureReader, countsARecordOfNoPossibleTime)
{
  HandmadePcapng file;
  file.block(1, {1, 4096, 0x00010009, 0, 0});  // Ethernet, if_tsresol: seconds
  file.block(6, {0, 1200, 0, 4, 4, 0});        // second 1200 * 2^32
  file.block(6, {0, 0, 0xFFFFFFFF, 4, 4, 0});  // year 2106
  const Contents contents = file.contents();
  EXPECT_EQ(contents.counters.records, 2u);
  EXPECT_EQ(contents.counters.malformed, 2u);  // the second one is too short for Ethernet
}

TEST(CaptureReader, readsInterfacesOfAnyLinkTypeAndSnapLengthAndCountsThoseWithoutIp)
{
  constexpr std::uint16_t kEthernet = 1, kCooked = 113, kUsb = 189;
  const ByteVector cooked = ByteVector(14, 0) + be16(0x0800) + kPacket;
  for (const bool big_endian : {false, true})
  {
    HandmadePcapng file(big_endian);
    file.interface(kEthernet, 262144).interface(kUsb, 0).interface(kCooked, 65535);
    file.packet(0, 1, ethernet(kPacket)).packet(1, 2, content(64)).packet(2, 3, cooked);
    const Contents contents = file.contents();
    EXPECT_THAT(payloads(contents), ElementsAre(kPayload, kPayload));
    EXPECT_EQ(contents.datagrams.back().received, Timestamp{3us});
    EXPECT_EQ(contents.counters.records, 3u);
    EXPECT_EQ(contents.counters.not_udp, 1u);
    EXPECT_TRUE(contents.counters.damages.empty());
  }
}

TEST(CaptureReader, namesTheLinkTypeIfNoInterfaceCarriesIp)
{
  HandmadePcapng file;
  file.interface(189, 0).packet(0, 1, content(64));
  try
  {
    file.contents();
    FAIL();
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_THAT(error.what(), HasSubstr("USB_LINUX"));
  }
}

TEST(CaptureReader, scalesStampsByTheInterfacesResolutionAndOffset)
{
  HandmadePcapng file;
  file.block(1, {1, 0, 0x00010009, 9, 0x0008000E, 100, 0, 0});  // nanoseconds, 100 s to be added
  file.block(1, {1, 0, 0x00010009, 0x80 | 20, 0});              // 2^-20 s
  file.block(1, {1, 0, 0x00010009, 12, 0});                     // picoseconds
  file.packet(0, 1'234'567'891, ethernet(kPacket)).packet(1, 3u << 19, ethernet(kPacket));
  file.packet(2, 4'000'001'999, ethernet(kPacket));
  const Contents contents = file.contents();
  ASSERT_EQ(contents.datagrams.size(), 3u);
  EXPECT_EQ(contents.datagrams[0].received, Timestamp{101s + 234'567'891ns});
  EXPECT_EQ(contents.datagrams[1].received, Timestamp{1500ms});
  EXPECT_EQ(contents.datagrams[2].received, Timestamp{4'000'001ns});
}

TEST(CaptureReader, deliversWhatIsBeforeADamageOfPcapng)
{
  const auto damageBehind = [](const std::function<void(HandmadePcapng&)>& add)
  {
    HandmadePcapng file;
    file.interface(1, 0).packet(0, 1, ethernet(kPacket));
    add(file);
    const Contents contents = file.contents();
    EXPECT_EQ(contents.datagrams.size(), 1u);
    return contents.counters.damages.empty() ? "none" : contents.counters.damages.front();
  };
  EXPECT_THAT(damageBehind([](auto& file) { file.packet(1, 2, content(64)); }), HasSubstr("not described"));
  EXPECT_THAT(damageBehind([](auto& file) { file.block(6, {0, 0, 0, 400, 400}); }), HasSubstr("shorter"));
  EXPECT_THAT(damageBehind([](auto& file) { file.block(1, {1, 0, 0x00010009, 20, 0}); }), HasSubstr("10^-20"));
  EXPECT_THAT(damageBehind([](auto& file) { file.block(0x0A0D0D0A, {7, 1, 0, 0}); }), HasSubstr("byte order"));
}

TEST(CaptureReader, takesFractionsOfASecondThatAreTooLargeForMicrosecondsForNanoseconds)
{
  HandmadeCapture capture;
  for (int i = 0; i < 40; ++i) capture.add(ethernet(kPacket), 1750000000s + 25ms * i + 5ms);
  const auto path = capture.file();
  const std::string content = contentOf(path);
  std::ofstream(path, std::ios::binary) << "\xd4\xc3\xb2\xa1" << content.substr(4);  // the magic of microseconds
  const Contents contents = read(path);
  ASSERT_EQ(contents.datagrams.size(), 40u);
  for (std::size_t i = 0; i < 40; ++i)
    EXPECT_EQ(contents.datagrams[i].received, Timestamp{1750000000s + 25ms * i + 5ms}) << i;
}

/** Opening one would wait for its writer, and recognition reads a file before its reader does. */
TEST(CaptureReader, refusesAPipeAtOnce)
{
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(CaptureReader(folder / "pipe"), std::runtime_error);
}

TEST(CaptureReader, progressEndsAtOne)
{
  HandmadeCapture capture;
  for (int i = 0; i < 10; ++i) capture.add(ethernet(kPacket));
  CaptureReader reader(capture.file());
  EXPECT_LT(reader.progress(), 0.5);
  for (Datagram datagram; reader.next(datagram);)
    ;
  EXPECT_DOUBLE_EQ(reader.progress(), 1.0);
}

TEST(CaptureReader, saysWhatAFileIsThatIsNoCapture)
{
  const HandmadeCapture folder;
  const auto file = [&](const std::string& name, const std::string& bytes)
  {
    std::ofstream(folder.folder() / name, std::ios::binary) << bytes;
    return folder.folder() / name;
  };
  EXPECT_THAT(errorOf(file("a.json", "{\"lidar_mode\": 1}")), HasSubstr("a JSON file"));
  EXPECT_THAT(errorOf(file("a.pcap.gz", "\x1f\x8b\x08 and so on")), HasSubstr("a gzip file"));
  EXPECT_THAT(errorOf(file("a.txt", "hello, world: a text")), HasSubstr("a text file"));
  EXPECT_THAT(errorOf(file("a.empty", "")), HasSubstr("an empty file"));
  EXPECT_THAT(errorOf(file("a.bin", std::string("\x01\x02\x03\x04\x00\x06", 6))), HasSubstr("a binary file"));
  EXPECT_THAT(errorOf(file("a.short.pcap", "\xd4\xc3\xb2\xa1 ends")), HasSubstr("a damaged capture"));
  EXPECT_THAT(errorOf(folder.folder() / "none.pcap"), HasSubstr("no such file"));
  EXPECT_THAT(errorOf(folder.folder()), HasSubstr("a folder"));
  EXPECT_THAT(errorOf(HandmadeCapture(105).file()), HasSubstr("IEEE802_11"));
}
}  // namespace
}  // namespace scanloom::capture_reader_unittest
