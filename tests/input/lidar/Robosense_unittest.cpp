#include "input/lidar/internal/Robosense.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "input/lidar/LidarModels.h"
#include "robosensePackets.h"

namespace scanloom::robosense_unittest
{
namespace
{
constexpr Timestamp kStamp{1'700'000'000'500'000'000ns};

const RobosenseModel& model(const char* name) { return modelNamed(kRobosenseModels, name); }

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
  const std::unique_ptr<PacketDecoder> decoder = robosenseDecoder(model);
};
INSTANTIATE_TEST_SUITE_P(Models, EveryRobosense, testing::ValuesIn(kRobosenseModels),
                         [](const auto& row)
                         {
                           std::string name(row.param.name);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(EveryRobosense, stampsItsFirstFiring)
{
  EXPECT_EQ(blocksOf(*decoder, robosensePacket(model, {}))[0].stamp, kStamp);
}

TEST_P(EveryRobosense, refusesWhatIsNotItsOwn)
{
  auto packet = robosensePacket(model, {});
  packet[17] = 2;
  EXPECT_EQ(decoder->kind(packet), model.unit_mm == 0 ? PacketKind::Malformed : PacketKind::Lidar) << "unit";
  packet = robosensePacket(model, {});
  packet[142] = 0;
  EXPECT_EQ(decoder->kind(packet), PacketKind::Malformed) << "no marker";
  packet = robosensePacket(model, {});
  storeBigEndian(packet, 0, 0xA5FF005A11115555, 8);
  EXPECT_EQ(decoder->kind(packet), PacketKind::Other) << "about the device";
}

TEST_P(EveryRobosense, callsTimesAndAnglesThatThereAreNotInvalid)
{
  RobosenseContent content;
  content.microseconds = 1'000'000;
  EXPECT_FALSE(blocksOf(*decoder, robosensePacket(model, content))[0].valid);
  EXPECT_TRUE(pointsOf(*decoder, robosensePacket(model, content), 0).empty());
  content.microseconds = 0;
  content.seconds = 4'700'000'000;  // 2118: beyond 62 bits of ns
  EXPECT_FALSE(blocksOf(*decoder, robosensePacket(model, content))[0].valid);
  auto packet = robosensePacket(model, {});
  storeBigEndian(packet, 44, 36000, 2);
  EXPECT_FALSE(blocksOf(*decoder, packet).front().valid);
  EXPECT_TRUE(blocksOf(*decoder, packet).back().valid);
}

TEST_P(EveryRobosense, waitsWhereTheFieldOfViewHasAGap)
{
  auto packet = robosensePacket(model, {});
  for (std::size_t block = 6; block < 12; ++block)
    storeBigEndian(packet, 44 + 100 * block, 9000 + 20 * block * (model.channels == 16 ? 2 : 1), 2);
  const auto blocks = blocksOf(*decoder, packet);
  const std::size_t behind = blocks.size() / 2;
  EXPECT_NEAR(seconds(blocks[behind].stamp - blocks[behind - 1].stamp), 0.025, 1e-4) << "a quarter of a turn";
}

TEST(Robosense, tellsModelsByTypeAndVersion)
{
  for (const RobosenseModel& one : kRobosenseModels)
    for (const RobosenseModel& other : kRobosenseModels)
      EXPECT_EQ(robosenseDecoder(one)->kind(robosensePacket(other, {})), one.name == other.name ? PacketKind::Lidar
                                                                         : one.marker == other.marker
                                                                             ? PacketKind::Foreign
                                                                             : PacketKind::Malformed);
}

/** Manuals and drivers of some models have it one byte further back than the table of models. */
TEST(Robosense, readsTheTypeOneByteFurtherBack)
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
    EXPECT_EQ(robosenseDecoder(model(row.written))->kind(packet), PacketKind::Lidar);
    EXPECT_EQ(robosenseDecoder(model(row.other))->kind(packet), PacketKind::Foreign);
  }
}

TEST(Robosense, takesOldPacketsWithoutAVersionByTheirType)
{
  auto packet = robosensePacket(model("Helios-5515"), {});
  packet[31] = 0;
  EXPECT_EQ(robosenseDecoder(model("Helios-5515"))->kind(packet), PacketKind::Lidar);
  EXPECT_EQ(robosenseDecoder(model("Helios-16P"))->kind(packet), PacketKind::Foreign);
  packet[30] = 7;
  EXPECT_EQ(robosenseDecoder(model("Helios-5515"))->kind(packet), PacketKind::Foreign);
  EXPECT_EQ(robosenseDecoder(model("Helios-16P"))->kind(packet), PacketKind::Lidar);
}

TEST(Robosense, knowsTheReturnsOf32ChannelsByTheirAzimuths)
{
  const RobosenseModel& helios = model("Helios-5515");
  EXPECT_THAT(modelsThatSend({robosensePacket(helios, {})}), testing::ElementsAre("Helios-5515"));
  EXPECT_THAT(modelsThatSend({robosensePacket(helios, twoReturns())}), testing::ElementsAre("Helios-5515 dual"));
}

TEST(Robosense, readsRangesInUnitsOfThePacket)
{
  const RobosenseModel& helios = model("Helios-5515");
  auto packet = robosensePacket(helios, {});
  packet[17] = 0;
  EXPECT_EQ(pointsOf(*robosenseDecoder(helios), packet, 0).range[0], 4000U);
}

}  // namespace scanloom::robosense_unittest
