#include "input/lidar/internal/VelodyneDecoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "input/lidar/LidarModels.h"
#include "input/packets/CaptureReader.h"
#include "support/TestData.h"
#include "velodynePackets.h"

namespace scanloom::velodyne_decoder_unittest
{
namespace
{
struct Sensor
{
  const char* file;
  VelodyneContent content;
  std::size_t blocks;
  Duration sequence;
  double metres_per_count;
};

VelodyneContent contentOf(std::uint8_t product_id, std::size_t banks)
{
  VelodyneContent content;
  content.product_id = product_id;
  if (product_id != 0x22) content.azimuth_step = 20;  // one sequence at about 10 Hz
  content.banks = banks;
  return content;
}

const Sensor kSensors[] = {
    {"vlp16", contentOf(0x22, 1), 24, 55296ns, 0.002},
    {"hdl32e", contentOf(0x21, 1), 12, 46080ns, 0.002},
    {"vlp32c", contentOf(0x28, 1), 12, 55296ns, 0.004},
    {"vls128", contentOf(0xA1, 4), 3, 55277ns, 0.004},
};

VelodyneDecoder vlp16(int returns = 1)
{
  VelodyneMetadata metadata = velodyneMetadata("vlp16");
  metadata.returns = returns;
  return {metadata, Rigid::identity()};
}
}  // namespace

class EveryVelodyne : public testing::TestWithParam<Sensor>
{
 protected:
  const Sensor sensor = GetParam();
  const VelodyneDecoder decoder{velodyneMetadata(sensor.file), Rigid::identity()};
};
INSTANTIATE_TEST_SUITE_P(Models, EveryVelodyne, testing::ValuesIn(kSensors),
                         [](const auto& sensor) { return std::string(sensor.param.file); });

TEST_P(EveryVelodyne, isFoundByItsFile)
{
  const auto made = makeDecoder(velodyneFile(sensor.file), Rigid::identity());
  EXPECT_EQ(made->description().lidar_port, 2368);
  EXPECT_EQ(made->description().stamp_modulus, Duration(3600s));
  EXPECT_EQ(made->description().numbering, Numbering::Stamps);
  EXPECT_EQ(made->description().blockPeriod(), sensor.sequence);
  EXPECT_EQ(made->kind(velodynePacket(sensor.content)), PacketKind::Lidar);
}

TEST_P(EveryVelodyne, firesOneBlockPerSequence)
{
  VelodyneContent content = sensor.content;
  content.microseconds = 1'000'000;
  const auto blocks = blocksOf(decoder, velodynePacket(content));
  ASSERT_EQ(blocks.size(), sensor.blocks);
  for (std::size_t i = 1; i < blocks.size(); ++i) EXPECT_EQ(blocks[i].stamp - blocks[i - 1].stamp, sensor.sequence);
}

/** x forward at azimuth 0, clockwise; every laser at its own angles and its own time: the manual's formula in double.
 */
TEST_P(EveryVelodyne, putsEveryLaserWhereTheManualSays)
{
  VelodyneContent content = sensor.content;
  content.azimuth = 35950;
  const auto packet = velodynePacket(content);
  const VelodyneMetadata& m = decoder.metadata();
  const double group = seconds(sensor.sequence) * (m.model->channels == 16 ? 2 : 1);
  const double rate = content.azimuth_step / group;  // 0.01 degrees per s

  for (std::size_t block = 0; block < sensor.blocks; ++block)
  {
    const PointCloud points = pointsOf(decoder, packet, block);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(m.model->channels));
    for (std::size_t laser = 0; laser < points.size(); ++laser)
    {
      const double shot = 1e-9 * points.t[laser];
      const double azimuth =
          M_PI / 18000 * (35950 + rate * (static_cast<double>(block) * seconds(sensor.sequence) + shot)) +
          M_PI / 180 * m.azimuth_offset_deg[laser];
      const double vertical = M_PI / 180 * m.vertical_deg[laser],
                   range = content.range_counts * sensor.metres_per_count;
      const Eigen::Vector3d expected(range * std::cos(vertical) * std::cos(azimuth),
                                     -range * std::cos(vertical) * std::sin(azimuth),
                                     range * std::sin(vertical) + 1e-3 * m.vertical_offset_mm[laser]);
      EXPECT_LT((points.position(laser).cast<double>() - expected).norm(), 2e-6) << block << ' ' << laser;
    }
  }
}

TEST_P(EveryVelodyne, countsRingsFromTheTop)
{
  const PointCloud points = pointsOf(decoder, velodynePacket(sensor.content), 0);
  std::vector<double> vertical_deg(points.size());
  for (std::size_t laser = 0; laser < points.size(); ++laser)
    vertical_deg.at(points.ring[laser]) = decoder.metadata().vertical_deg[laser];
  EXPECT_TRUE(std::is_sorted(vertical_deg.rbegin(), vertical_deg.rend()));
}

TEST_P(EveryVelodyne, refusesWhatIsNotItsOwn)
{
  auto packet = velodynePacket(sensor.content);
  packet[1205] = 0x31;
  EXPECT_EQ(decoder.kind(packet), PacketKind::Foreign);
  packet = velodynePacket(sensor.content);
  packet[1204] = 0x3A;
  EXPECT_EQ(decoder.kind(packet), PacketKind::Malformed) << "no such return mode";
  packet = velodynePacket(sensor.content);
  packet[1100] = 0;
  EXPECT_EQ(decoder.kind(packet), PacketKind::Malformed) << "no block there";
  packet.resize(1205);
  EXPECT_EQ(decoder.kind(packet), PacketKind::Malformed);
  EXPECT_EQ(decoder.kind(std::vector<std::uint8_t>(512)), PacketKind::Other) << "a position packet";
  EXPECT_EQ(decoder.kind({}), PacketKind::Malformed);
}

TEST(VelodyneDecoder, readsAnEarlyVlp16ThatSaysItIsAnHdl32eAndNoHdl32e)
{
  VelodyneContent early;
  early.product_id = 0x21;
  EXPECT_EQ(vlp16().kind(velodynePacket(early)), PacketKind::Lidar);
  early.azimuth_step = 17;  // 46.08 us of an HDL-32E at 600 rpm
  EXPECT_EQ(vlp16().kind(velodynePacket(early)), PacketKind::Foreign);

  VelodyneMetadata named = velodyneMetadata("vlp16");
  named.early_product_id = 0;  // as where the file has a product_id
  early.azimuth_step = 40;
  EXPECT_EQ(VelodyneDecoder(named, Rigid::identity()).kind(velodynePacket(early)), PacketKind::Foreign);
}

TEST(VelodyneDecoder, readsARealVlp16ThatSaysItIsAnHdl32eAndNoRealHdl32e)
{
  SCANLOOM_NEEDS_DATA(early, "other-lidars/jerry73204+rust-lidar-utils/velodyne-test/test_files/velodyne_vlp16.pcap");
  SCANLOOM_NEEDS_DATA(hdl32e, "other-lidars/MRPT+mrpt/modules/mrpt_data/tests/sample_velodyne_hdl32.pcap");
  const auto taken = [](const std::filesystem::path& capture)
  {
    int packets = 0;
    CaptureReader reader(capture);
    for (Datagram datagram; reader.next(datagram);) packets += vlp16().kind(datagram.payload) == PacketKind::Lidar;
    return packets;
  };
  EXPECT_EQ(taken(early), 84);  // INVENTORY
  EXPECT_EQ(taken(hdl32e), 0);
}

TEST(VelodyneDecoder, firesOneLaserAfterAnother)
{
  const PointCloud points = pointsOf(vlp16(), velodynePacket({}), 3);
  for (std::size_t laser = 0; laser < 16; ++laser) EXPECT_EQ(points.t[laser], static_cast<int>(laser) * 2304);
}

TEST(VelodyneDecoder, firesTheVls128InEightsWithAPauseInTheMiddle)
{
  const VelodyneDecoder vls128(velodyneMetadata("vls128"), Rigid::identity());
  const PointCloud points = pointsOf(vls128, velodynePacket(contentOf(0xA1, 4)), 0);
  EXPECT_EQ(points.t[7], 0);
  EXPECT_EQ(points.t[8], 2665);
  EXPECT_EQ(points.t[63], 7 * 2665);
  EXPECT_EQ(points.t[64], 9 * 2665);
  EXPECT_EQ(points.t[127], 16 * 2665);
}

TEST(VelodyneDecoder, givesTwoReturnsOfOneSequenceInOneBlock)
{
  VelodyneContent content;
  content.return_mode = 0x39;
  content.second_counts = 700;
  const auto packet = velodynePacket(content);
  ASSERT_EQ(vlp16(2).kind(packet), PacketKind::Lidar);
  ASSERT_EQ(blocksOf(vlp16(2), packet).size(), 12u);
  EXPECT_EQ(blocksOf(vlp16(2), packet)[11].stamp, Timestamp{11 * 55296ns});

  const PointCloud points = pointsOf(vlp16(2), packet, 11);
  ASSERT_EQ(points.size(), 32u);
  for (std::size_t laser = 0; laser < 16; ++laser)
  {
    EXPECT_EQ(points.range[laser], 1000u);
    EXPECT_EQ(points.range[16 + laser], 1400u);
    EXPECT_EQ(points.t[16 + laser], points.t[laser]);
    EXPECT_EQ(points.intensity[laser], 16 + laser) << "the second sequence of its blocks";
  }
}

TEST(VelodyneDecoder, refusesPacketsWithAnotherNumberOfReturnsThanItsFileSays)
{
  VelodyneContent two;
  two.return_mode = 0x39;
  EXPECT_EQ(vlp16(1).kind(velodynePacket(two)), PacketKind::Malformed);
  EXPECT_EQ(vlp16(2).kind(velodynePacket({})), PacketKind::Malformed);
  EXPECT_EQ(vlp16(2).description().columns_per_packet, 12);
}

TEST(VelodyneDecoder, leavesOutASecondReturnWhereTheFirstIs)
{
  VelodyneContent content;
  content.return_mode = 0x39;
  EXPECT_EQ(pointsOf(vlp16(2), velodynePacket(content), 0).size(), 16u);
}

TEST(VelodyneDecoder, callsAPairOfTwoAzimuthsInvalid)
{
  VelodyneContent content;
  content.return_mode = 0x39;
  auto packet = velodynePacket(content);
  packet[302] ^= 1;
  for (const MeasurementBlock& block : blocksOf(vlp16(2), packet))
    EXPECT_EQ(block.valid, block.index != 2 && block.index != 3) << block.index;
  EXPECT_TRUE(pointsOf(vlp16(2), packet, 2).empty());
}

TEST(VelodyneDecoder, beginsTheHourAnewWithinAPacket)
{
  VelodyneContent content;
  content.microseconds = 3'599'999'500;
  const auto blocks = blocksOf(vlp16(), velodynePacket(content));
  EXPECT_EQ(blocks[9].stamp, Timestamp{Duration(3600s) - 500us + 9 * 55296ns});
  EXPECT_EQ(blocks[10].stamp, Timestamp{10 * 55296ns - 500us});
  content.microseconds = 3'600'000'500;  // of a counter that goes on past the hour
  const MeasurementBlock past = blocksOf(vlp16(), velodynePacket(content))[0];
  EXPECT_TRUE(past.valid);
  EXPECT_EQ(past.stamp, Timestamp{500us});
}

TEST(VelodyneDecoder, stampsTheVls128sFirstShotBeforeThePacketsStamp)
{
  const VelodyneDecoder vls128(velodyneMetadata("vls128"), Rigid::identity());
  const auto blocks = blocksOf(vls128, velodynePacket(contentOf(0xA1, 4)));
  EXPECT_EQ(blocks[0].stamp, Timestamp{Duration(3600s) - 8700ns}) << "of the hour before";
  EXPECT_EQ(blocks[1].stamp, Timestamp{55277ns - 8700ns});
}

TEST(VelodyneDecoder, knowsHowLongAGapInTheFieldOfViewWas)
{
  VelodyneContent content;
  content.azimuth = 8940;
  auto packet = velodynePacket(content);
  for (std::size_t block = 6; block < 12; ++block)  // 9140 is the last one before the rotor comes round to 27000
    store(packet, block * 100 + 2, static_cast<std::uint16_t>(27000 + 40 * (block - 6)));
  const auto blocks = blocksOf(vlp16(), packet);
  const double turned = (27000 - 9140) / 36000.0 * 0.1;
  EXPECT_NEAR(seconds(blocks[12].stamp - blocks[10].stamp), turned, 111e-6);
  EXPECT_LE(seconds(blocks[12].stamp - blocks[10].stamp), turned) << "never behind the next packet";
  EXPECT_EQ((blocks[12].stamp - blocks[10].stamp) % 110592ns, 0ns) << "lasers fire in step";
  EXPECT_EQ(blocks[13].stamp - blocks[12].stamp, 55296ns);
}

TEST(VelodyneDecoder, takesOneDamagedAzimuthForNoGap)
{
  auto packet = velodynePacket({});
  store(packet, 502, std::uint16_t{20000});
  EXPECT_EQ(blocksOf(vlp16(), packet).back().stamp, Timestamp{23 * 55296ns});
}

TEST(VelodyneDecoder, isNotMisledByAnEncoderThatTrembles)
{
  VelodyneContent content;
  content.azimuth_step = 0;
  auto packet = velodynePacket(content);
  packet[502] = 0;  // of 36000: one count back from the next
  store(packet, 502, std::uint16_t{35999});
  const auto blocks = blocksOf(vlp16(), packet);
  EXPECT_EQ(blocks.back().stamp, Timestamp{23 * 55296ns});
}

TEST(VelodyneDecoder, numbersColumnsByAzimuth)
{
  VelodyneContent content;
  content.azimuth = 35960;
  const auto blocks = blocksOf(vlp16(), velodynePacket(content));
  EXPECT_EQ(vlp16().description().columns_per_frame, 1808);  // 0.1 s of 55.296 us
  EXPECT_EQ(blocks[0].measurement_id, 1805);                 // 359.6 degrees
  EXPECT_EQ(blocks[1].measurement_id, 1806);
  EXPECT_EQ(blocks[2].measurement_id, 0);
}

TEST(VelodyneDecoder, takes360DegreesFor0)
{
  auto packet = velodynePacket({});
  store(packet, 2, std::uint16_t{36000});
  const auto blocks = blocksOf(vlp16(), packet);
  EXPECT_TRUE(blocks[0].valid) << "real sensors send it";
  EXPECT_EQ(blocks[0].measurement_id, 0);
  EXPECT_EQ(pointsOf(vlp16(), packet, 0).x, pointsOf(vlp16(), velodynePacket({}), 0).x);
  store(packet, 2, std::uint16_t{36001});
  EXPECT_FALSE(blocksOf(vlp16(), packet)[0].valid);
}

TEST(VelodyneDecoder, foldsTheExtrinsicsIn)
{
  const Rigid body_T_sensor = Rigid::fromXyzYawPitchRoll(1, 2, 3, 0.5, -0.1, 0.2);
  const VelodyneDecoder mounted(velodyneMetadata("vlp16"), body_T_sensor);
  const auto packet = velodynePacket({});
  const PointCloud own = pointsOf(vlp16(), packet, 5), body = pointsOf(mounted, packet, 5);
  for (std::size_t i = 0; i < own.size(); ++i)
    EXPECT_LT((body_T_sensor * own.position(i).cast<double>() - body.position(i).cast<double>()).norm(), 2e-6);
}

TEST(VelodyneDecoder, readsNothingPastTheEnd)
{
  EXPECT_THROW(blocksOf(vlp16(), std::vector<std::uint8_t>(1205)), std::out_of_range);
  EXPECT_THROW(pointsOf(vlp16(), velodynePacket({}), 24), std::out_of_range);
}

struct VelodyneMistake
{
  const char* name;
  nlohmann::json key;
  const char* says;
};
class VelodyneMistakes : public testing::TestWithParam<VelodyneMistake>
{
};
INSTANTIATE_TEST_SUITE_P(
    Keys, VelodyneMistakes,
    testing::Values(VelodyneMistake{"noModel", {{"model", nullptr}}, "model: is missing; known are VLP-16"},
                    VelodyneMistake{"otherModel", {{"model", "HDL-64E"}}, "'HDL-64E' is unknown; known are VLP-16"},
                    VelodyneMistake{"tooFewAngles", {{"vertical_angles_deg", {1, 2}}}, "must have 16 numbers"},
                    VelodyneMistake{"noAngles", {{"vertical_angles_deg", nullptr}}, "vertical_angles_deg: is missing"},
                    VelodyneMistake{"upright", {{"vertical_angles_deg", {200}}}, "must be a number from -90 to 90"},
                    VelodyneMistake{"fast", {{"rpm", 12000}}, "rpm: must be a number from 300 to 1200"},
                    VelodyneMistake{"threeReturns", {{"returns", 3}}, "returns: must be a whole number from 1 to 2"},
                    VelodyneMistake{"oneEnd", {{"field_of_view_deg", {90}}}, "must be [first, last]"}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

TEST_P(VelodyneMistakes, areSaidWithKeyAndCure)
{
  nlohmann::json json = nlohmann::json::parse(readMetadataText(velodyneFile("vlp16")));
  json.update(GetParam().key);
  try
  {
    parseVelodyneMetadata(json.dump(), "front.json");
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& e)
  {
    EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr("front.json"), testing::HasSubstr(GetParam().says)));
  }
}
}  // namespace scanloom::velodyne_decoder_unittest
