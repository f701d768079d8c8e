#include "input/lidar/internal/RobosenseDecoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "input/lidar/LidarModels.h"
#include "robosensePackets.h"
#include "velodynePackets.h"

namespace scanloom::robosense_decoder_unittest
{
namespace
{
constexpr Timestamp kStamp{1'700'000'000'500'000'000ns};

const RobosenseModel& model(const char* name) { return *findRobosenseModel(name); }

RobosenseContent twoReturns()
{
  RobosenseContent content;
  content.returns = 2;
  return content;
}
}  // namespace

class EveryRobosense : public testing::TestWithParam<RobosenseModel>
{
 protected:
  const RobosenseModel model = GetParam();
  const RobosenseDecoder decoder = robosenseDecoder(model);
};
INSTANTIATE_TEST_SUITE_P(Models, EveryRobosense, testing::ValuesIn(kRobosenseModels),
                         [](const auto& row)
                         {
                           std::string name(row.param.name);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(EveryRobosense, isFoundByItsFile)
{
  const auto made = makeDecoder(robosenseText(model), "its file", Rigid::identity());
  EXPECT_EQ(made->description().model, model.name);
  EXPECT_EQ(made->description().lidar_port, 6699);
  EXPECT_NEAR(made->description().columns_per_frame, 1800, 2);
  EXPECT_EQ(made->kind(robosensePacket(model, {})), PacketKind::Lidar);
}

TEST_P(EveryRobosense, firesOneBlockPerPeriodWithAllReturns)
{
  const auto single = blocksOf(decoder, robosensePacket(model, {}));
  ASSERT_EQ(single.size(), 384U / static_cast<std::size_t>(model.channels));
  for (std::size_t i = 0; i < single.size(); ++i)
    EXPECT_EQ(single[i].stamp - kStamp, model.sequence * static_cast<int>(i));
  const RobosenseDecoder dual = robosenseDecoder(model, 2);
  const auto packet = robosensePacket(model, twoReturns());
  ASSERT_EQ(dual.kind(packet), PacketKind::Lidar);
  EXPECT_EQ(blocksOf(dual, packet).size(), single.size() / 2);
  const PointCloud points = pointsOf(dual, packet, 1);
  ASSERT_EQ(points.size(), 2 * static_cast<std::size_t>(model.channels));
  const auto unit = static_cast<std::uint32_t>(model.unit_mm == 5 ? 2 : 1);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(points.range[i], unit * (i < points.size() / 2 ? 2000U : 3000U));
}

/** x forward at azimuth 0, clockwise; the lens turns with the rotor; every channel at its own angles and azimuth. */
TEST_P(EveryRobosense, putsEveryChannelWhereTheRotorIsWhenItFires)
{
  RobosenseContent content;
  content.azimuth = 35950;
  const auto packet = robosensePacket(model, content);
  const AngleTable& angles = decoder.metadata().angles;
  const double range = model.unit_mm == 5 ? 4 : 2, sequence = static_cast<double>(model.sequence.count());
  for (std::size_t block = 0; block < blocksOf(decoder, packet).size(); ++block)
  {
    const PointCloud points = pointsOf(decoder, packet, block);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(model.channels));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const double rotor = M_PI / 180 * (359.5 + 0.2 * (static_cast<double>(block) + points.t[i] / sequence));
      const double azimuth = rotor + M_PI / 180 * angles.azimuth[i], vertical = M_PI / 180 * angles.vertical[i];
      const Eigen::Vector3d expected(range * std::cos(vertical) * std::cos(azimuth) + model.lens_m * std::cos(rotor),
                                     -range * std::cos(vertical) * std::sin(azimuth) - model.lens_m * std::sin(rotor),
                                     range * std::sin(vertical) + model.lens_z_m);
      EXPECT_LT((points.position(i).cast<double>() - expected).norm(), 2e-6) << block << ' ' << i;
    }
  }
}

TEST_P(EveryRobosense, timesEachChannelFromTheFirst)
{
  const PointCloud points = pointsOf(decoder, robosensePacket(model, {}), 0);
  EXPECT_EQ(points.t[0], 0);
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_LT(points.t[i], model.sequence.count());
  EXPECT_EQ(points.ring[0], 0) << "its topmost beam";
}

TEST_P(EveryRobosense, refusesWhatIsNotItsOwn)
{
  auto packet = robosensePacket(model, {});
  packet[17] = 2;
  EXPECT_EQ(decoder.kind(packet), model.unit_mm == 0 ? PacketKind::Malformed : PacketKind::Lidar) << "unit";
  packet = robosensePacket(model, {});
  packet[142] = 0;
  EXPECT_EQ(decoder.kind(packet), PacketKind::Malformed) << "no marker";
  packet = robosensePacket(model, {});
  storeBigEndian(packet, 0, 0xA5FF005A11115555, 8);
  EXPECT_EQ(decoder.kind(packet), PacketKind::Other) << "about the device";
  packet.pop_back();
  EXPECT_EQ(decoder.kind(packet), PacketKind::Malformed);
  EXPECT_THROW(blocksOf(decoder, packet), std::out_of_range);
  EXPECT_THROW(pointsOf(decoder, robosensePacket(model, {}), 24), std::out_of_range);
  EXPECT_EQ(decoder.kind({}), PacketKind::Malformed);
}

TEST_P(EveryRobosense, callsTimesAndAnglesThatThereAreNotInvalid)
{
  RobosenseContent content;
  content.microseconds = 1'000'000;
  EXPECT_FALSE(blocksOf(decoder, robosensePacket(model, content))[0].valid);
  EXPECT_TRUE(pointsOf(decoder, robosensePacket(model, content), 0).empty());
  content.microseconds = 0;
  content.seconds = 4'700'000'000;  // 2118: beyond 62 bits of ns
  EXPECT_FALSE(blocksOf(decoder, robosensePacket(model, content))[0].valid);
  auto packet = robosensePacket(model, {});
  storeBigEndian(packet, 44, 36000, 2);
  EXPECT_FALSE(blocksOf(decoder, packet).front().valid);
  EXPECT_TRUE(blocksOf(decoder, packet).back().valid);
}

TEST_P(EveryRobosense, waitsWhereTheFieldOfViewHasAGap)
{
  auto packet = robosensePacket(model, {});
  for (std::size_t block = 6; block < 12; ++block)
    storeBigEndian(packet, 44 + 100 * block, 9000 + 20 * block * (model.channels == 16 ? 2 : 1), 2);
  const auto blocks = blocksOf(decoder, packet);
  const std::size_t behind = blocks.size() / 2;
  EXPECT_NEAR(seconds(blocks[behind].stamp - blocks[behind - 1].stamp), 0.025, 1e-4) << "a quarter of a turn";
}

TEST(RobosenseDecoder, tellsModelsByTypeAndVersion)
{
  for (const RobosenseModel& one : kRobosenseModels)
    for (const RobosenseModel& other : kRobosenseModels)
      EXPECT_EQ(robosenseDecoder(one).kind(robosensePacket(other, {})), one.name == other.name ? PacketKind::Lidar
                                                                        : one.marker == other.marker
                                                                            ? PacketKind::Foreign
                                                                            : PacketKind::Malformed);
}

/** Manuals and drivers of some models have it one byte further back than the table of models. */
TEST(RobosenseDecoder, readsTheTypeOneByteFurtherBack)
{
  struct Row
  {
    const char *written, *other;
    std::uint8_t type, version;
  };
  for (const Row& row : {Row{"Helios-16P", "Helios-5515", 6, 3}, Row{"Bpearl-V4", "Bpearl-V3", 3, 4}})
  {
    auto packet = robosensePacket(model(row.written), {});
    packet[30] = 0;
    packet[31] = row.type;
    packet[32] = row.version;
    EXPECT_EQ(robosenseDecoder(model(row.written)).kind(packet), PacketKind::Lidar);
    EXPECT_EQ(robosenseDecoder(model(row.other)).kind(packet), PacketKind::Foreign);
  }
}

TEST(RobosenseDecoder, takesOldPacketsWithoutAVersionByTheirType)
{
  auto packet = robosensePacket(model("Helios-5515"), {});
  packet[31] = 0;
  EXPECT_EQ(robosenseDecoder(model("Helios-5515")).kind(packet), PacketKind::Lidar);
  EXPECT_EQ(robosenseDecoder(model("Helios-16P")).kind(packet), PacketKind::Foreign);
  packet[30] = 7;
  EXPECT_EQ(robosenseDecoder(model("Helios-5515")).kind(packet), PacketKind::Foreign);
  EXPECT_EQ(robosenseDecoder(model("Helios-16P")).kind(packet), PacketKind::Lidar);
}

TEST(RobosenseDecoder, knowsTheReturnsOf32ChannelsByTheirAzimuths)
{
  const RobosenseModel& helios = model("Helios-5515");
  EXPECT_EQ(robosenseDecoder(helios, 2).kind(robosensePacket(helios, {})), PacketKind::Malformed);
  EXPECT_EQ(robosenseDecoder(helios).kind(robosensePacket(helios, twoReturns())), PacketKind::Malformed);
  EXPECT_THAT(modelsThatSend({robosensePacket(helios, {})}), testing::ElementsAre("Helios-5515"));
  EXPECT_THAT(modelsThatSend({robosensePacket(helios, twoReturns())}), testing::ElementsAre("Helios-5515 dual"));
}

TEST(RobosenseDecoder, readsRangesInUnitsOfThePacket)
{
  const RobosenseModel& helios = model("Helios-5515");
  auto packet = robosensePacket(helios, {});
  packet[17] = 0;
  EXPECT_EQ(pointsOf(robosenseDecoder(helios), packet, 0).range[0], 4000U);
}

TEST(RobosenseMetadata, saysWhatIsWrongWithKeyAndCure)
{
  const auto said = [](const nlohmann::json& change) -> std::string
  {
    nlohmann::json json = nlohmann::json::parse(robosenseText(model("Helios-16P")));
    json.update(change);
    try
    {
      parseRobosenseMetadata(json.dump(), "folder/front.json");
      return "accepted";
    }
    catch (const std::invalid_argument& e)
    {
      return e.what();
    }
  };
  EXPECT_THAT(said({{"model", "M1"}}), testing::HasSubstr("'M1' is unknown; known are Helios-5515"));
  EXPECT_THAT(said({{"vertical_angles_deg", {1, 2}}}), testing::HasSubstr("must have 16 numbers"));
  EXPECT_THAT(said({{"angles", "none.csv"}}), testing::HasSubstr("folder/none.csv: metadata file can't be read"));
  EXPECT_THAT(said({{"returns", 3}}), testing::HasSubstr("returns: must be a whole number from 1 to 2"));
  EXPECT_THAT(said({{"field_of_view_deg", {1}}}), testing::HasSubstr("must be [first, last]"));
}
}  // namespace scanloom::robosense_decoder_unittest
