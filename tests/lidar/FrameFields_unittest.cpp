#include "lidar/FrameFields.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <fstream>

#include "captures.h"
#include "lidar/Digest.h"

using namespace scanloom;

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
