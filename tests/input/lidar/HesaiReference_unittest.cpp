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

std::filesystem::path theFile(const std::filesystem::path& folder, const std::string& extension)
{
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == extension) return entry.path();
  throw std::runtime_error(folder.string() + ": has no " + extension);
}

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
  const HesaiDecoder decoder(metadata, Rigid::identity());

  PointCloud cloud;
  std::vector<MeasurementBlock> blocks;
  const auto packets = pandarPacketsOfBag(theFile(folder, ".db3"));
  EXPECT_EQ(packets.size(), GetParam().packets);
  for (const StampedPacket& packet : packets)
  {
    ASSERT_EQ(decoder.kind(packet.bytes), PacketKind::Lidar);
    decoder.readBlocks(packet.bytes, blocks);
    for (const MeasurementBlock& block : blocks) decoder.appendPoints(packet.bytes, block.index, 0, 0, cloud);
  }
  if (builtInMetadata(GetParam().model))
  {
    EXPECT_EQ(modelsThatSend({packets.front().bytes}), std::vector{std::string(GetParam().model) + " dual"});
  }

  std::vector<Eigen::Vector3f> ours;
  for (std::size_t i = 0; i < cloud.size(); ++i) ours.push_back(cloud.position(i));
  const auto theirs = readPlainPcd(theFile(folder, ".pcd"));
  EXPECT_EQ(shareFound(theirs, ours, 0), 1) << "within 0.1 mm";
}
}  // namespace scanloom::hesai_reference_unittest
