/** Recordings of four models, decoded by us and by other programs. */
#include <gtest/gtest.h>

#include <algorithm>

#include "captures.h"
#include "support/PointFile.h"
#include "support/Rosbag.h"
#include "support/shareFound.h"
#include "velodynePackets.h"

namespace scanloom::velodyne_reference_unittest
{
namespace
{
const std::string kNebula =
    "other-lidars/tier4+nebula/src/nebula_velodyne/nebula_velodyne/test_resources/decoder_ground_truth/";
const std::string kVeloView = "other-lidars/Kitware+VeloView/Testing/Data/";
}  // namespace

/**
 * Nebula looks angles up in steps of 0.01 degrees, and turns the rotor on while a sequence fires in a way of its own:
 * not at all in the last of six pairs of blocks (VLP-16, two returns) or in two of three sequences (VLS-128), and laser
 * by laser where they fire in pairs (VLP-32C). So the last two models are decoded its way here; the rest
 * of the points, all ranges and all angles have to agree, but for a hundredth of a degree of Nebula's table and as much
 * of the encoder's noise, which it takes from one pair of azimuths and we from a packet.
 */
constexpr double kAngle_deg = 0.02;

constexpr std::array<std::int32_t, 128> kAtOnce{};
constexpr std::array<std::int32_t, 32> kOneByOne = []() constexpr
{
  std::array<std::int32_t, 32> times{};
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = 2304 * static_cast<std::int32_t>(i);
  return times;
}
();

struct NebulaCloud
{
  const char* model;
  const char* folder;
  ShotTimes shots;
  int returns;
  double least_share;
};
class NebulaClouds : public testing::TestWithParam<NebulaCloud>
{
};
INSTANTIATE_TEST_SUITE_P(Models, NebulaClouds,
                         testing::Values(NebulaCloud{"vlp16", "vlp16", shotTimes(kOneByOne), 2, 0.83},
                                         NebulaCloud{"vlp32c", "vlp32", shotTimes(kOneByOne), 1, 0.92},
                                         NebulaCloud{"vls128", "vls128", shotTimes(kAtOnce), 1, 0.83}),
                         [](const auto& cloud) { return std::string(cloud.param.model); });

TEST_P(NebulaClouds, consistOfPointsOfOurs)
{
  SCANLOOM_NEEDS_DATA(folder, kNebula + GetParam().folder);
  VelodyneMetadata metadata = velodyneMetadata(GetParam().model);
  std::fill(metadata.vertical_offset_mm.begin(), metadata.vertical_offset_mm.end(), 0.0);  // not in their calibration
  VelodyneModel model = *metadata.model;
  model.shots = GetParam().shots;
  metadata.model = &model;
  metadata.returns = GetParam().returns;

  const auto packets = packetsOfBag(theFile(folder, ".db3"), kVelodynePacketBytes);
  const auto decoder = makeVelodyne(metadata, Rigid::identity());
  for (const auto& packet : packets) ASSERT_EQ(decoder->kind(packet), PacketKind::Lidar);
  const auto ours = positionsOf(everyPoint(*decoder, packets)), theirs = readPlainPcd(theFile(folder, ".pcd"));
  EXPECT_GT(shareFound(theirs, ours, kAngle_deg), GetParam().least_share);

  std::vector<Eigen::Vector3f> turned = theirs;
  for (auto& p : turned) p = Eigen::AngleAxisf(static_cast<float>(0.1 * M_PI / 180), Eigen::Vector3f::UnitZ()) * p;
  EXPECT_LT(shareFound(turned, ours, kAngle_deg), 0.1);
}

/** VeloView's own test files: how many points each turn has, and where some of them are, in the maker's axes. */
struct KnownPoint
{
  std::size_t turn, point;
  Eigen::Vector3f position;
  float intensity;
};
struct VeloViewCapture
{
  const char* name;
  const char* model;
  std::size_t turns;
  std::vector<std::pair<std::size_t, std::size_t>> points_of;  // turn, points
  std::vector<KnownPoint> points;
};
class VeloViewCaptures : public testing::TestWithParam<VeloViewCapture>
{
};
INSTANTIATE_TEST_SUITE_P(Files, VeloViewCaptures,
                         testing::Values(VeloViewCapture{"monterey-first-100-packets.pcap",
                                                         "hdl32e",
                                                         19,
                                                         {{0, 27649}, {2, 49485}, {8, 49737}, {11, 49778}, {18, 396}},
                                                         {{8, 1, {0.0218793f, 7.83493f, -1.28724f}, 1},
                                                          {8, 4000, {4.3412700f, 8.20269f, -1.97267f}, 28},
                                                          {8, 16000, {77.6108f, -26.7235f, 3.82785f}, 63},
                                                          {8, 49733, {-0.0050133f, 5.74481f, -1.79261f}, 1}}},
                                         VeloViewCapture{"vlp-16-test-90deg-1-50-frames.pcap",
                                                         "vlp16",
                                                         52,
                                                         {{0, 5736}, {2, 13898}, {16, 13860}, {51, 274}},
                                                         {{16, 0, {0.0801272f, 6.04037f, -1.61865f}, 4},
                                                          {16, 13859, {-0.0308793f, 4.91453f, 1.31687f}, 29}}}),
                         [](const auto& capture) { return std::string(capture.param.model); });

TEST_P(VeloViewCaptures, giveTheTurnsAndPointsThatVeloViewGives)
{
  SCANLOOM_NEEDS_DATA(capture, kVeloView + GetParam().name);
  VelodyneMetadata metadata = velodyneMetadata(GetParam().model);
  VelodyneModel model = *metadata.model;
  model.shots = shotTimes(kAtOnce);  // VeloView gives all points of a sequence the azimuth of its first
  metadata.model = &model;
  metadata.product_id = 0x21;  // the VLP-16 is an early one that says HDL-32E
  std::fill(metadata.vertical_offset_mm.begin(), metadata.vertical_offset_mm.end(), 0.0);
  const auto decoder = makeVelodyne(metadata, Rigid::identity());

  std::vector<PointCloud> turns(1);
  int last_azimuth = 0;
  for (const auto& packet : payloadsOf(capture))
  {
    if (decoder->kind(packet) != PacketKind::Lidar) continue;
    for (const MeasurementBlock& block : blocksOf(*decoder, packet))
    {
      const auto data_block = block.index * 12 / decoder->description().columns_per_packet;
      const int azimuth = load<std::uint16_t>(packet, static_cast<std::size_t>(data_block) * 100 + 2);
      if (azimuth < last_azimuth) turns.emplace_back();
      last_azimuth = azimuth;
      decoder->appendPoints(packet, block.index, 0, 0, turns.back());
    }
  }
  ASSERT_EQ(turns.size(), GetParam().turns);
  for (const auto& [turn, points] : GetParam().points_of) EXPECT_EQ(turns[turn].size(), points) << "turn " << turn;
  for (const KnownPoint& known : GetParam().points)
  {
    const Eigen::Vector3f ours = turns[known.turn].position(known.point);
    const Eigen::Vector3f in_makers_axes(-ours.y(), ours.x(), ours.z());
    EXPECT_LT((in_makers_axes - known.position).norm(), 1e-3f) << in_makers_axes.transpose();
    EXPECT_EQ(turns[known.turn].intensity[known.point], known.intensity);
  }
}
}  // namespace scanloom::velodyne_reference_unittest
