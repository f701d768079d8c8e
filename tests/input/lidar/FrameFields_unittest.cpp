#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <fstream>

#include "base/core/Digest.h"
#include "captures.h"
#include "simpleMetadata.h"
#include "support/FrameFields.h"

namespace scanloom::frame_fields_unittest
{
namespace
{
const std::vector<std::string> kDigested{"OS-0-32-U1_v2.2.0_1024x10", "OS-1-32-G_v2.1.1_1024x10",
                                         "OS-2-128-U1_v2.3.0_1024x10"};

std::vector<FieldFrame> framesOf(const OusterDecoder& decoder, const std::vector<std::vector<std::uint8_t>>& packets)
{
  FrameFields fields(decoder);
  std::vector<FieldFrame> frames;
  const auto keep = [&frames](std::vector<FieldFrame> more)
  {
    for (FieldFrame& frame : more) frames.push_back(std::move(frame));
  };
  for (const auto& packet : packets)
    if (decoder.kind(packet) == PacketKind::Lidar) keep(fields.push(packet));
  keep(fields.finish());
  return frames;
}

nlohmann::json readJson(const std::filesystem::path& path)
{
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}
}  // namespace

TEST(FrameFields, everyDigestOfTheMakersDecodeIsOurs)
{
  int compared = 0;
  for (const std::string& name : kDigested)
  {
    SCANLOOM_NEEDS_DATA(capture, kOusterCaptures + name + ".pcap");
    SCANLOOM_NEEDS_DATA(metadata, kOusterCaptures + name + ".json");
    SCANLOOM_NEEDS_DATA(reference, kOusterCaptures + name + "_digest.json");
    const OusterDecoder decoder = decoderOf(metadata);
    const auto frames = framesOf(decoder, payloadsOf(capture));
    const nlohmann::json scans = readJson(reference)["scans"];
    ASSERT_EQ(frames.size(), scans.size()) << name;
    for (std::size_t i = 0; i < scans.size(); ++i)
    {
      auto digests = digestsOf(frames[i]);
      for (const auto& [field, expected] : scans[i].items())
      {
        if (field == "ENCODER_COUNT") continue;  // obsolete
        EXPECT_EQ(digests[field], expected.get<std::string>()) << name << " " << field;
        ++compared;
      }
    }
  }
  RecordProperty("recordings", static_cast<int>(kDigested.size()));
  RecordProperty("digests_compared", compared);
  EXPECT_EQ(compared, 8 + 8 + 11);
}

TEST(FrameFields, everyNamedDigestOfThePacketsIsOurs)
{
  int compared = 0;
  for (const std::string& name : kDigested)
  {
    SCANLOOM_NEEDS_DATA(capture, kOusterCaptures + name + ".pcap");
    SCANLOOM_NEEDS_DATA(metadata, kOusterCaptures + name + ".json");
    SCANLOOM_NEEDS_DATA(reference, kOusterCaptures + name + "_digest.json");
    const OusterDecoder decoder = decoderOf(metadata);
    std::map<std::string, std::vector<std::uint8_t>> values;  // packet after packet
    for (const auto& packet : payloadsOf(capture))
      if (decoder.kind(packet) == PacketKind::Lidar)
        for (const FieldImage& image : fieldsOf(decoder, packet).fields)
          values[image.name].insert(values[image.name].end(), image.values.begin(), image.values.end());

    const nlohmann::json expected = readJson(reference)["packet_hash"];
    for (const auto& [field, bytes] : values)
    {
      if (!expected.contains(field)) continue;  // WINDOW came later than the digests
      EXPECT_EQ(md5(bytes), expected[field].get<std::string>()) << name << " " << field;
      ++compared;
    }
  }
  RecordProperty("digests_compared", compared);
  EXPECT_EQ(compared, 9 + 5 + 5);
}

namespace
{
/** The range of one pixel. */
std::uint32_t rangeAt(const FieldFrame& frame, std::size_t channel, std::size_t column)
{
  std::uint32_t range = 0;
  std::memcpy(&range, &frame.fields[0].values[4 * (channel * frame.timestamp.size() + column)], 4);
  return range;
}
}  // namespace

TEST(FrameFields, aLatePacketFindsItsTurnAndInvalidOrLostColumnsAreZero)
{
  const OusterMetadata m = simpleMetadata("RNG19_RFL8_SIG16_NIR16", 4, 16);
  const OusterDecoder decoder(m, Rigid::identity());
  const OusterEncoder encoder(m);
  const auto packet = [&](std::uint32_t frame_id, std::uint16_t first_column, bool valid = true)
  {
    auto columns = randomColumns(m, 1, frame_id, first_column);
    for (OusterColumn& column : columns) column.readings[2].first.range_mm = 1000u * frame_id + first_column;
    columns[3].valid = valid;
    return encoder.lidarPacket(columns);
  };
  const auto frames = framesOf(decoder, {packet(8, 0), packet(9, 0, false), packet(8, 32), packet(10, 0)});

  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[0].frame_id, 8u);
  EXPECT_EQ(rangeAt(frames[0], 2, 5), 8000u);
  EXPECT_EQ(rangeAt(frames[0], 2, 20), 0u) << "never came";
  EXPECT_EQ(rangeAt(frames[0], 2, 37), 8032u) << "came late";
  EXPECT_EQ(frames[0].measurement_id[37], 37);
  EXPECT_EQ(frames[1].frame_id, 9u);
  EXPECT_EQ(rangeAt(frames[1], 2, 3), 0u) << "invalid";
  EXPECT_EQ(frames[1].status[3], 0u);
  EXPECT_EQ(rangeAt(frames[1], 2, 4), 9000u);
  EXPECT_EQ(frames[2].frame_id, 10u);
}

TEST(Digest, isMd5)
{
  const std::string text = "message digest";  // RFC 1321, appendix A.5
  EXPECT_EQ(md5({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}), "f96b697d7cb7938d525a2f31aaf161d0");
  EXPECT_EQ(md5({}), "d41d8cd98f00b204e9800998ecf8427e");
}
}  // namespace scanloom::frame_fields_unittest
