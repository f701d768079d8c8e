/**
 * A recording of a Helios-5515, which another program decoded as if it were a Helios-16P: its own packet about the
 * device holds angles of 32 channels.
 */
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/formats/CloudFile.h"
#include "input/lidar/BuiltInModels.h"
#include "input/lidar/LidarModels.h"
#include "robosensePackets.h"
#include "support/Rosbag.h"
#include "support/TestData.h"
#include "support/shareFound.h"

namespace scanloom::robosense_reference_unittest
{
namespace
{
const std::string kNebula = "other-lidars/tier4+nebula/";
const std::string kRecording = kNebula + "nebula_tests/data/robosense/helios16P";

std::vector<std::vector<std::uint8_t>> recordedIn(const std::filesystem::path& folder)
{
  const auto decoder = makeDecoder("Helios-5515", Rigid::identity());
  auto packets = bytesOf(robosensePacketsOfBag(theFile(folder, ".db3")));
  EXPECT_EQ(packets.size(), 751U);
  const auto behind = std::remove_if(packets.begin(), packets.end(),
                                     [&](const auto& packet) { return decoder->kind(packet) == PacketKind::Other; });
  EXPECT_EQ(packets.end() - behind, 1) << "about the device";
  packets.erase(behind, packets.end());
  return packets;
}
}  // namespace

/** Their azimuths are cut off to 0.01 degrees, and turn with the step to the next block, not with the packet's mean. */
TEST(RobosenseClouds, consistOfPointsOfOursIfReadAsTheyWere)
{
  SCANLOOM_NEEDS_DATA(folder, kRecording);
  SCANLOOM_NEEDS_DATA(angles, kNebula + "nebula_decoders/calibration/robosense/RobosenseHelios16P.csv");
  const auto decoder = makeRobosense(
      parseRobosenseMetadata(R"({"model": "Helios-16P", "angles": "RobosenseHelios16P.csv"})", angles.string()),
      Rigid::identity());
  const std::vector<Eigen::Vector3f> ours = positionsOf(everyPoint(*decoder, recordedIn(folder)));
  int clouds = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder))
  {
    if (file.path().extension() != ".gz") continue;
    const std::vector<Eigen::Vector3f> theirs = readCloud(file.path()).points;
    EXPECT_GT(shareFound(theirs, ours, 0.025), 0.9998) << "within 0.1 mm and 0.025 degrees";
    EXPECT_GT(shareFound(theirs, ours, 0), 0.68) << "within 0.1 mm";
    EXPECT_GT(shareFound(theirs, ours, 0, 2e-3), 0.98);
    ++clouds;
  }
  EXPECT_EQ(clouds, 3);
}

TEST(RobosenseRecording, isOfAHelios5515)
{
  SCANLOOM_NEEDS_DATA(folder, kRecording);
  const auto packets = recordedIn(folder);
  EXPECT_EQ(modelsThatSend({packets.front()}), std::vector<std::string>{"Helios-5515"});
  const auto decoder = makeDecoder("Helios-5515", Rigid::identity());
  for (const auto& packet : packets) ASSERT_EQ(decoder->kind(packet), PacketKind::Lidar);
}

/** Its twelve lowest beams see one floor on the right: with the angles of another model they would not. */
TEST(RobosenseRecording, showsALevelFloor)
{
  SCANLOOM_NEEDS_DATA(folder, kRecording);
  const PointCloud cloud = everyPoint(*makeDecoder("Helios-5515", Rigid::identity()), recordedIn(folder));
  std::map<int, std::vector<float>> heights;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.ring[i] >= 20 && cloud.column[i] >= 300 && cloud.column[i] < 600)
      heights[cloud.ring[i]].push_back(cloud.z[i]);
  ASSERT_EQ(heights.size(), 12U);
  for (auto& [ring, z] : heights)
  {
    std::nth_element(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2), z.end());
    EXPECT_NEAR(z[z.size() / 2], -0.68, ring == 28 ? 0.09 : 0.02) << "ring " << ring;
  }
}
}  // namespace scanloom::robosense_reference_unittest
