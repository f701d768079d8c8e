/** Real captures compared with what tshark reads from them, also after conversion by stock tools. */
#include "HandmadeCapture.h"
#include "input/packets/CaptureReader.h"
#include "support/TestData.h"
#include "support/mergedCaptures.h"
#include "support/stockTool.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace scanloom::recorded_captures_unittest
{
namespace
{
using testing::ElementsAreArray;

constexpr const char* kOuster = "ouster/ouster-lidar+ouster-sdk/tests/pcaps/";

/** One line per datagram, as tshark's fields below. */
template <typename Reader>
std::vector<std::string> describe(Reader& reader)
{
  std::vector<std::string> lines;
  for (Datagram d; reader.next(d);)
  {
    const std::int64_t ns = nanoseconds(d.received);
    std::string hex;
    for (const std::uint8_t byte : d.payload) hex += fmt::format("{:02x}", byte);
    lines.push_back(fmt::format("{}.{:09},{},{},{},{}", ns / 1'000'000'000, ns % 1'000'000'000, d.source.text(),
                                d.source_port, d.destination_port, hex));
  }
  return lines;
}

std::vector<std::string> ours(const std::filesystem::path& path)
{
  CaptureReader reader(path);
  return describe(reader);
}

std::vector<std::string> tsharks(const std::filesystem::path& path)
{
  return linesOf(
      "tshark -n -r '" + path.string() +
      "' -Y udp -T fields -E separator=, -E occurrence=f -e frame.time_epoch -e ip.src -e udp.srcport -e udp.dstport"
      " -e udp.payload");
}

class RecordedCapture : public testing::TestWithParam<std::string>
{
};

TEST_P(RecordedCapture, holdsTheDatagramsThatTsharkFinds)
{
  SCANLOOM_NEEDS_DATA(path, GetParam());
  SCANLOOM_NEEDS_TOOL("tshark");
  const auto expected = tsharks(path);
  EXPECT_TRUE(ours(path) == expected) << "of " << expected.size() << " datagrams";
}

INSTANTIATE_TEST_SUITE_P(All, RecordedCapture,
                         testing::Values(std::string(kOuster) + "OS-0-32-U1_v2.2.0_1024x10.pcap",
                                         std::string(kOuster) + "OS-1-64_1024x10_fw20.pcap",
                                         std::string(kOuster) + "OS-1-128_v2.3.0_1024x10_lb_n3.pcap",
                                         std::string(kOuster) + "OS-1-128_767798045_1024x10_20230712_120049.pcap",
                                         std::string(kOuster) + "same_ports.pcap",
                                         std::string(kOuster) + "same_ports_legacy.pcap",
                                         std::string(kOuster) + "empty_pcap.pcap",
                                         std::string(kOuster) + "VLI-16-one-packet.pcap",
                                         std::string(kOuster) + "windowed_frame1.pcap",
                                         "other-lidars/MRPT+mrpt/modules/mrpt_data/tests/sample_velodyne_hdl32.pcap",
                                         "other-lidars/Kitware+VeloView/Testing/Data/monterey-first-100-packets.pcap"));

TEST(RecordedCaptures, haveTheCountsOfTheirInventory)
{
  struct Count
  {
    const char* file;
    std::map<int, int> datagrams_at;
  };
  for (const Count& expected :
       {Count{"OS-1-128_v2.3.0_1024x10_lb_n3.pcap", {{7502, 192}, {7503, 30}}},
        Count{"crc_test.pcap", {{7502, 34}, {7503, 10}}},
        Count{"OS-2-128-U1_v2.3.0_1024x10.pcap", {{7502, 64}, {7503, 10}}}, Count{"same_ports.pcap", {{7502, 4}}},
        Count{"OS-1-32-G_v2.1.1_1024x10.pcap", {{7502, 64}}}})
  {
    SCANLOOM_NEEDS_DATA(path, std::string(kOuster) + expected.file);
    CaptureReader reader(path);
    std::map<int, int> found;
    for (Datagram datagram; reader.next(datagram);) ++found[datagram.destination_port];
    EXPECT_EQ(found, expected.datagrams_at) << expected.file;
    EXPECT_EQ(reader.counters().fragments_expired + reader.counters().malformed, 0u) << expected.file;
  }
}

class Converted : public testing::TestWithParam<std::pair<const char*, const char*>>
{
};

TEST_P(Converted, holdsTheSame)
{
  const auto [name, editcap] = GetParam();
  SCANLOOM_NEEDS_DATA(path, std::string(kOuster) + "same_ports.pcap");
  SCANLOOM_NEEDS_TOOL("editcap");
  const HandmadeCapture folder;
  const auto converted = folder.folder() / "converted";
  linesOf(fmt::format("editcap {} '{}' '{}'", editcap, path.string(), converted.string()));
  EXPECT_TRUE(ours(converted) == ours(path));
}

INSTANTIATE_TEST_SUITE_P(All, Converted,
                         testing::Values(std::pair("ToPcapng", "-F pcapng"),
                                         std::pair("ToNanosecondPcap", "-F nsecpcap"),
                                         std::pair("ToModifiedPcap", "-F modpcap"),
                                         std::pair("ToMicrosecondPcap", "-F pcap")),
                         [](const auto& test) { return test.param.first; });

TEST(RecordedCaptures, keepNanosecondsInPcapng)
{
  SCANLOOM_NEEDS_TOOL("editcap");
  HandmadeCapture capture;
  capture.add(ethernet(ipv4Packet(udp(7502, content(10)))), 1750000000s + 123456789ns);
  const auto converted = capture.folder() / "a.pcapng";
  linesOf(fmt::format("editcap -F pcapng {} {}", capture.file().string(), converted.string()));
  CaptureReader reader(converted);
  Datagram datagram;
  ASSERT_TRUE(reader.next(datagram));
  EXPECT_EQ(nanoseconds(datagram.received), 1750000000123456789);
}

TEST(RecordedCaptures, survivePcapngCutAnywhere)
{
  SCANLOOM_NEEDS_DATA(path, std::string(kOuster) + "same_ports.pcap");
  SCANLOOM_NEEDS_TOOL("editcap");
  const HandmadeCapture folder;
  const auto whole = folder.folder() / "whole.pcapng", cut = folder.folder() / "cut.pcapng";
  linesOf(fmt::format("editcap -F pcapng '{}' '{}'", path.string(), whole.string()));
  const auto expected = ours(whole);

  std::size_t most = 0;
  for (std::uintmax_t length = std::filesystem::file_size(whole) - 1; length > 1000; length -= 997)
  {
    std::filesystem::copy_file(whole, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(cut, length);
    CaptureReader reader(cut);
    const auto lines = describe(reader);
    ASSERT_LT(lines.size(), expected.size()) << length;
    ASSERT_TRUE(std::equal(lines.begin(), lines.end(), expected.begin())) << length;
    ASSERT_TRUE(reader.counters().truncated || length % 4 == 0) << length;
    most = std::max(most, lines.size());
  }
  EXPECT_EQ(most, expected.size() - 1);
}

TEST(RecordedCaptures, loseOneDatagramForOneLostFragment)
{
  SCANLOOM_NEEDS_DATA(path, std::string(kOuster) + "same_ports.pcap");
  SCANLOOM_NEEDS_TOOL("editcap");
  const HandmadeCapture folder;
  const auto lossy = folder.folder() / "lossy.pcap";
  linesOf(fmt::format("editcap '{}' '{}' 7", path.string(), lossy.string()));  // without record 7
  CaptureReader reader(lossy);
  EXPECT_EQ(describe(reader).size(), 3u);
  EXPECT_EQ(reader.counters().fragments_expired, 1u);
  EXPECT_EQ(reader.counters().fragments_joined, 1u);
}

/** Its first record is a lone fragment with the id that a whole datagram bears 88 s later; tshark joins it to that one.
 */
TEST(RecordedCaptures, keepALoneFragmentOutOfALaterDatagramOfItsId)
{
  SCANLOOM_NEEDS_DATA(path, std::string(kOuster) + "duplicate_id.pcap");
  SCANLOOM_NEEDS_TOOL("tshark");
  const HandmadeCapture folder;
  const auto later = folder.folder() / "later.pcap";
  linesOf(fmt::format("editcap '{}' '{}' 1", path.string(), later.string()));  // without record 1
  CaptureReader reader(path);
  EXPECT_TRUE(describe(reader) == tsharks(later));
  EXPECT_EQ(reader.counters().fragments_expired, 1u);
}

TEST(MergedCaptures, agreeWithMergecap)
{
  SCANLOOM_NEEDS_DATA(a, std::string(kOuster) + "same_ports.pcap");
  SCANLOOM_NEEDS_TOOL("mergecap");
  SCANLOOM_NEEDS_TOOL("editcap");
  const HandmadeCapture folder;
  const auto b = folder.folder() / "later.pcap", merged = folder.folder() / "merged.pcap";
  linesOf(fmt::format("editcap -t 0.0021 '{}' '{}'", a.string(), b.string()));
  linesOf(fmt::format("mergecap -F pcap -w '{}' '{}' '{}'", merged.string(), a.string(), b.string()));

  MergedCaptures ours_merged = mergedCaptures({a, b});
  const auto lines = describe(ours_merged);
  EXPECT_EQ(lines.size(), 8u);
  EXPECT_TRUE(std::is_permutation(lines.begin(), lines.end(), ours(merged).begin()));
  EXPECT_TRUE(std::is_sorted(lines.begin(), lines.end(),
                             [](const auto& x, const auto& y) { return x.substr(0, 20) < y.substr(0, 20); }));
}
}  // namespace
}  // namespace scanloom::recorded_captures_unittest
