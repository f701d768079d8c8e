/** Recordings of seven models, decoded by us and by another program. */
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>

#include "hesaiPackets.h"
#include "input/lidar/BuiltInModels.h"
#include "input/lidar/LidarModels.h"
#include "support/PointFile.h"
#include "support/Rosbag.h"
#include "support/TestData.h"
#include "support/shareFound.h"

namespace scanloom::hesai_reference_unittest
{
namespace
{
const std::string kHesai = "other-lidars/tier4+nebula/src/nebula_hesai/";

struct RecordedHesai
{
  const char* model;
  const char* folder;
  const char* angles;
  std::size_t packets;
};
class HesaiClouds : public testing::TestWithParam<RecordedHesai>
{
};
INSTANTIATE_TEST_SUITE_P(Models, HesaiClouds,
                         testing::Values(RecordedHesai{"XT32", "xt32", "PandarXT32.csv", 2000},
                                         RecordedHesai{"40P", "40p", "Pandar40P.csv", 1439},
                                         RecordedHesai{"64", "64", "Pandar64.csv", 2400},
                                         RecordedHesai{"XT16", "xt16", "PandarXT16.csv", 1626},
                                         RecordedHesai{"XT32M", "xt32m", "PandarXT32M.csv", 1815},
                                         RecordedHesai{"QT64", "qt64", "PandarQT64.csv", 1200},
                                         RecordedHesai{"QT128", "qt128", "PandarQT128.csv", 1800}),
                         [](const auto& sensor) { return std::string(sensor.param.folder); });
}  // namespace

TEST_P(HesaiClouds, consistOfPointsOfOurs)
{
  SCANLOOM_NEEDS_DATA(folder, kHesai + "nebula_hesai/test_resources/decoder_ground_truth/" + GetParam().folder);
  SCANLOOM_NEEDS_DATA(angles, kHesai + "nebula_hesai_decoders/calibration/" + GetParam().angles);
  const HesaiMetadata metadata = parseHesaiMetadata(
      fmt::format(R"({{"model": "{}", "returns": 2, "angles": "{}"}})", GetParam().model, angles.filename().string()),
      angles.string());
  const auto decoder = makeHesai(metadata, Rigid::identity());

  const auto packets = bytesOf(pandarPacketsOfBag(theFile(folder, ".db3")));
  EXPECT_EQ(packets.size(), GetParam().packets);
  for (const auto& packet : packets) ASSERT_EQ(decoder->kind(packet), PacketKind::Lidar);
  if (builtInMetadata(GetParam().model))
  {
    EXPECT_EQ(modelsThatSend({packets.front()}), std::vector{std::string(GetParam().model) + " dual"});
  }

  const auto theirs = readPlainPcd(theFile(folder, ".pcd"));
  EXPECT_EQ(shareFound(theirs, positionsOf(everyPoint(*decoder, packets)), 0), 1) << "within 0.1 mm";
}
}  // namespace scanloom::hesai_reference_unittest
