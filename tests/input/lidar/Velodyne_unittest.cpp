#include "input/lidar/internal/Velodyne.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "input/packets/CaptureReader.h"
#include "support/TestData.h"
#include "velodynePackets.h"

namespace scanloom::velodyne_unittest
{
namespace
{
std::unique_ptr<PacketDecoder> vlp16(int returns = 1)
{
  VelodyneMetadata metadata = velodyneMetadata("vlp16");
  metadata.returns = returns;
  return makeVelodyne(metadata, Rigid::identity());
}

std::unique_ptr<PacketDecoder> vls128() { return makeVelodyne(velodyneMetadata("vls128"), Rigid::identity()); }

VelodyneContent contentOf(const VelodyneModel& model)
{
  VelodyneContent content;
  content.product_id = model.product_id;
  content.banks = model.channels == 128 ? 4 : 1;
  return content;
}

const VelodyneModel& kVls128 = modelNamed(kVelodyneModels, "VLS-128");
}  // namespace

class EveryVelodyne : public testing::TestWithParam<const char*>
{
};
INSTANTIATE_TEST_SUITE_P(Models, EveryVelodyne, testing::Values("vlp16", "hdl32e", "vlp32c", "vls128"));

TEST_P(EveryVelodyne, refusesWhatIsNotItsOwn)
{
  const VelodyneMetadata metadata = velodyneMetadata(GetParam());
  const auto decoder = makeVelodyne(metadata, Rigid::identity());
  const auto sound = velodynePacket(contentOf(*metadata.model));
  auto packet = sound;
  packet[1205] = 0x31;
  EXPECT_EQ(decoder->kind(packet), PacketKind::Foreign);
  packet = sound;
  packet[1204] = 0x3A;
  EXPECT_EQ(decoder->kind(packet), PacketKind::Malformed) << "no such return mode";
  packet = sound;
  packet[1100] = 0;
  EXPECT_EQ(decoder->kind(packet), PacketKind::Malformed) << "no block there";
  EXPECT_EQ(decoder->kind(std::vector<std::uint8_t>(512)), PacketKind::Other) << "a position packet";
}

TEST(Velodyne, readsAnEarlyVlp16ThatSaysItIsAnHdl32eAndNoHdl32e)
{
  VelodyneContent early;
  early.product_id = 0x21;
  EXPECT_EQ(vlp16()->kind(velodynePacket(early)), PacketKind::Lidar);
  early.azimuth_step = 17;  // 46.08 us of an HDL-32E at 600 rpm
  EXPECT_EQ(vlp16()->kind(velodynePacket(early)), PacketKind::Foreign);

  VelodyneMetadata named = velodyneMetadata("vlp16");
  named.early_product_id = 0;  // as where the file has a product_id
  early.azimuth_step = 40;
  EXPECT_EQ(makeVelodyne(named, Rigid::identity())->kind(velodynePacket(early)), PacketKind::Foreign);
}

TEST(Velodyne, readsARealVlp16ThatSaysItIsAnHdl32eAndNoRealHdl32e)
{
  SCANLOOM_NEEDS_DATA(early, "other-lidars/jerry73204+rust-lidar-utils/velodyne-test/test_files/velodyne_vlp16.pcap");
  SCANLOOM_NEEDS_DATA(hdl32e, "other-lidars/MRPT+mrpt/modules/mrpt_data/tests/sample_velodyne_hdl32.pcap");
  const auto taken = [](const std::filesystem::path& capture)
  {
    int packets = 0;
    CaptureReader reader(capture);
    for (Datagram datagram; reader.next(datagram);) packets += vlp16()->kind(datagram.payload) == PacketKind::Lidar;
    return packets;
  };
  EXPECT_EQ(taken(early), 84);  // INVENTORY
  EXPECT_EQ(taken(hdl32e), 0);
}

TEST(Velodyne, firesOneLaserAfterAnother)
{
  const PointCloud points = pointsOf(*vlp16(), velodynePacket({}), 3);
  for (std::size_t laser = 0; laser < 16; ++laser) EXPECT_EQ(points.t[laser], static_cast<int>(laser) * 2304);
}

TEST(Velodyne, firesTheVls128InEightsWithAPauseInTheMiddle)
{
  const PointCloud points = pointsOf(*vls128(), velodynePacket(contentOf(kVls128)), 0);
  EXPECT_EQ(points.t[7], 0);
  EXPECT_EQ(points.t[8], 2665);
  EXPECT_EQ(points.t[63], 7 * 2665);
  EXPECT_EQ(points.t[64], 9 * 2665);
  EXPECT_EQ(points.t[127], 16 * 2665);
}

TEST(Velodyne, givesTwoReturnsOfOneSequenceInOneBlock)
{
  VelodyneContent content;
  content.return_mode = 0x39;
  content.second_counts = 700;
  const auto packet = velodynePacket(content);
  ASSERT_EQ(vlp16(2)->kind(packet), PacketKind::Lidar);
  ASSERT_EQ(blocksOf(*vlp16(2), packet).size(), 12u);
  EXPECT_EQ(blocksOf(*vlp16(2), packet)[11].stamp, Timestamp{11 * 55296ns});

  const PointCloud points = pointsOf(*vlp16(2), packet, 11);
  ASSERT_EQ(points.size(), 32u);
  for (std::size_t laser = 0; laser < 16; ++laser)
  {
    EXPECT_EQ(points.range[laser], 1000u);
    EXPECT_EQ(points.range[16 + laser], 1400u);
    EXPECT_EQ(points.t[16 + laser], points.t[laser]);
    EXPECT_EQ(points.intensity[laser], 16 + laser) << "the second sequence of its blocks";
  }
}

TEST(Velodyne, leavesOutASecondReturnWhereTheFirstIs)
{
  VelodyneContent content;
  content.return_mode = 0x39;
  EXPECT_EQ(pointsOf(*vlp16(2), velodynePacket(content), 0).size(), 16u);
}

TEST(Velodyne, callsAPairOfTwoAzimuthsInvalid)
{
  VelodyneContent content;
  content.return_mode = 0x39;
  auto packet = velodynePacket(content);
  packet[302] ^= 1;
  for (const MeasurementBlock& block : blocksOf(*vlp16(2), packet))
    EXPECT_EQ(block.valid, block.index != 2 && block.index != 3) << block.index;
  EXPECT_TRUE(pointsOf(*vlp16(2), packet, 2).empty());
}

TEST(Velodyne, beginsTheHourAnewWithinAPacket)
{
  VelodyneContent content;
  content.microseconds = 3'599'999'500;
  const auto blocks = blocksOf(*vlp16(), velodynePacket(content));
  EXPECT_EQ(blocks[9].stamp, Timestamp{Duration(3600s) - 500us + 9 * 55296ns});
  EXPECT_EQ(blocks[10].stamp, Timestamp{10 * 55296ns - 500us});
  content.microseconds = 3'600'000'500;  // of a counter that goes on past the hour
  const MeasurementBlock past = blocksOf(*vlp16(), velodynePacket(content))[0];
  EXPECT_TRUE(past.valid);
  EXPECT_EQ(past.stamp, Timestamp{500us});
}

TEST(Velodyne, stampsTheVls128sFirstShotBeforeThePacketsStamp)
{
  const auto blocks = blocksOf(*vls128(), velodynePacket(contentOf(kVls128)));
  EXPECT_EQ(blocks[0].stamp, Timestamp{Duration(3600s) - 8700ns}) << "of the hour before";
  EXPECT_EQ(blocks[1].stamp, Timestamp{55277ns - 8700ns});
}

TEST(Velodyne, knowsHowLongAGapInTheFieldOfViewWas)
{
  VelodyneContent content;
  content.azimuth = 8940;
  auto packet = velodynePacket(content);
  for (std::size_t block = 6; block < 12; ++block)  // 9140 is the last one before the rotor comes round to 27000
    store(packet, block * 100 + 2, static_cast<std::uint16_t>(27000 + 40 * (block - 6)));
  const auto blocks = blocksOf(*vlp16(), packet);
  const double turned = (27000 - 9140) / 36000.0 * 0.1;
  EXPECT_NEAR(seconds(blocks[12].stamp - blocks[10].stamp), turned, 111e-6);
  EXPECT_LE(seconds(blocks[12].stamp - blocks[10].stamp), turned) << "never behind the next packet";
  EXPECT_EQ((blocks[12].stamp - blocks[10].stamp) % 110592ns, 0ns) << "lasers fire in step";
  EXPECT_EQ(blocks[13].stamp - blocks[12].stamp, 55296ns);
}

TEST(Velodyne, takesOneDamagedAzimuthForNoGap)
{
  auto packet = velodynePacket({});
  store(packet, 502, std::uint16_t{20000});
  EXPECT_EQ(blocksOf(*vlp16(), packet).back().stamp, Timestamp{23 * 55296ns});
}

TEST(Velodyne, isNotMisledByAnEncoderThatTrembles)
{
  VelodyneContent content;
  content.azimuth_step = 0;
  auto packet = velodynePacket(content);
  packet[502] = 0;  // of 36000: one count back from the next
  store(packet, 502, std::uint16_t{35999});
  const auto blocks = blocksOf(*vlp16(), packet);
  EXPECT_EQ(blocks.back().stamp, Timestamp{23 * 55296ns});
}

TEST(Velodyne, numbersColumnsByAzimuth)
{
  VelodyneContent content;
  content.azimuth = 35960;
  const auto blocks = blocksOf(*vlp16(), velodynePacket(content));
  EXPECT_EQ(vlp16()->description().columns_per_frame, 1808);  // 0.1 s of 55.296 us
  EXPECT_EQ(blocks[0].measurement_id, 1805);                  // 359.6 degrees
  EXPECT_EQ(blocks[1].measurement_id, 1806);
  EXPECT_EQ(blocks[2].measurement_id, 0);
}

TEST(Velodyne, takes360DegreesFor0)
{
  auto packet = velodynePacket({});
  store(packet, 2, std::uint16_t{36000});
  const auto blocks = blocksOf(*vlp16(), packet);
  EXPECT_TRUE(blocks[0].valid) << "real sensors send it";
  EXPECT_EQ(blocks[0].measurement_id, 0);
  EXPECT_EQ(pointsOf(*vlp16(), packet, 0).x, pointsOf(*vlp16(), velodynePacket({}), 0).x);
  store(packet, 2, std::uint16_t{36001});
  EXPECT_FALSE(blocksOf(*vlp16(), packet)[0].valid);
}
}  // namespace scanloom::velodyne_unittest
