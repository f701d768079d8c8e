#include "input/lidar/internal/HesaiDecoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "hesaiPackets.h"
#include "input/lidar/LidarModels.h"
#include "velodynePackets.h"

namespace scanloom::hesai_decoder_unittest
{
namespace
{
constexpr Timestamp kStamp{1'677'673'815'500'000'000ns};  // 2023-03-01 12:30:15.5

HesaiDecoder decoderOf(const HesaiModel& model, int returns = 1)
{
  return {hesaiMetadata(std::string(model.name), returns), Rigid::identity()};
}

const HesaiModel& model(const char* name) { return *findHesaiModel(name); }
}  // namespace

class EveryHesai : public testing::TestWithParam<HesaiModel>
{
 protected:
  const HesaiModel model = GetParam();
  const HesaiDecoder decoder = decoderOf(model);
};
INSTANTIATE_TEST_SUITE_P(Models, EveryHesai, testing::ValuesIn(kHesaiModels),
                         [](const auto& row) { return std::string(row.param.name); });

TEST_P(EveryHesai, isFoundByItsFile)
{
  const auto made = makeDecoder(hesaiText(model), "its file", Rigid::identity());
  EXPECT_EQ(made->description().model, model.name);
  EXPECT_EQ(made->description().lidar_port, 2368);
  EXPECT_EQ(made->description().blockPeriod(), model.block);
  EXPECT_EQ(made->kind(hesaiPacket(model, {})), PacketKind::Lidar);
}

TEST_P(EveryHesai, firesOneBlockPerPeriodWithAllReturns)
{
  const auto single = blocksOf(decoder, hesaiPacket(model, {}));
  ASSERT_EQ(single.size(), static_cast<std::size_t>(model.blocks));
  for (std::size_t i = 1; i < single.size(); ++i) EXPECT_EQ(single[i].stamp - single[i - 1].stamp, model.block);
  HesaiContent two;
  two.return_mode = 0x39;
  const HesaiDecoder dual = decoderOf(model, 2);
  ASSERT_EQ(dual.kind(hesaiPacket(model, two)), PacketKind::Lidar);
  EXPECT_EQ(blocksOf(dual, hesaiPacket(model, two)).size(), single.size() / 2);
  const PointCloud points = pointsOf(dual, hesaiPacket(model, two), 0);
  ASSERT_EQ(points.size(), 2 * static_cast<std::size_t>(model.channels));
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(points.range[i], i < points.size() / 2 ? 2000u : 2800u);
}

/** y forward at azimuth 0, clockwise; every channel at its own angles: the manual's formula in double. */
TEST_P(EveryHesai, putsEveryChannelWhereTheManualSays)
{
  HesaiContent content;
  content.azimuth = 35990;
  const auto packet = hesaiPacket(model, content);
  const HesaiMetadata& m = decoder.metadata();
  for (std::size_t block = 0; block < static_cast<std::size_t>(model.blocks); ++block)
  {
    const PointCloud points = pointsOf(decoder, packet, block);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(model.channels));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const double azimuth = M_PI / 180 * (359.9 + 0.2 * static_cast<double>(block) + m.azimuth_offset_deg[i]);
      const double vertical = M_PI / 180 * m.vertical_deg[i];
      const Eigen::Vector3d expected(2 * std::cos(vertical) * std::sin(azimuth),
                                     2 * std::cos(vertical) * std::cos(azimuth), 2 * std::sin(vertical));
      EXPECT_LT((points.position(i).cast<double>() - expected).norm(), 2e-6) << block << ' ' << i;
    }
  }
}

TEST_P(EveryHesai, countsRingsFromTheTopAndTimesFromTheFirstShot)
{
  const PointCloud points = pointsOf(decoder, hesaiPacket(model, {}), 0);
  std::vector<double> vertical_deg(points.size());
  std::int32_t first = 1'000'000, last = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    vertical_deg.at(points.ring[i]) = decoder.metadata().vertical_deg[i];
    first = std::min(first, points.t[i]);
    last = std::max(last, points.t[i]);
  }
  EXPECT_TRUE(std::is_sorted(vertical_deg.rbegin(), vertical_deg.rend()));
  EXPECT_EQ(first, 0);
  EXPECT_LT(Duration{last}, model.block);
}

TEST_P(EveryHesai, refusesWhatIsNotItsOwn)
{
  auto packet = hesaiPacket(model, {});
  packet[model.tailAt() + model.tail.return_mode] = 0x3D;
  EXPECT_EQ(decoder.kind(packet), PacketKind::Malformed) << "three returns";
  packet[model.tailAt() + model.tail.return_mode] = 0x39;
  EXPECT_EQ(decoder.kind(packet), PacketKind::Malformed) << "two returns, unlike its file";
  packet = hesaiPacket(model, {});
  packet[0] = 0;
  EXPECT_EQ(decoder.kind(packet), PacketKind::Malformed) << "no marker";
  packet.pop_back();
  EXPECT_EQ(decoder.kind(packet), PacketKind::Malformed);
  EXPECT_THROW(blocksOf(decoder, packet), std::out_of_range);
  EXPECT_THROW(pointsOf(decoder, hesaiPacket(model, {}), 10), std::out_of_range);
  EXPECT_EQ(decoder.kind({}), PacketKind::Malformed);
}

TEST_P(EveryHesai, callsDatesAndAnglesThatThereAreNotInvalid)
{
  HesaiContent content;
  content.month = 13;
  EXPECT_FALSE(blocksOf(decoder, hesaiPacket(model, content))[0].valid);
  EXPECT_TRUE(pointsOf(decoder, hesaiPacket(model, content), 0).empty());
  auto packet = hesaiPacket(model, {});
  store(packet, model.header_bytes + model.azimuth_at, std::uint16_t{36001});
  EXPECT_FALSE(blocksOf(decoder, packet)[0].valid);
  EXPECT_TRUE(blocksOf(decoder, packet)[1].valid);
}

TEST(HesaiDecoder, stampsTheFirstShotInUtc)
{
  // The manuals' tables of block times, plus the earliest channel's.
  const auto firstAndLast = [](const char* name)
  {
    const auto blocks = blocksOf(decoderOf(model(name)), hesaiPacket(model(name), {}));
    return std::pair{blocks.front().stamp - kStamp, blocks.back().stamp - kStamp};
  };
  EXPECT_EQ(firstAndLast("XT32"), std::pair(Duration{5632 + 368 - 350'000}, Duration{5632 + 368}));
  EXPECT_EQ(firstAndLast("40P"), std::pair(Duration{-28580 - 54670 - 9 * 55560}, Duration{-28580 - 54670}));
  EXPECT_EQ(firstAndLast("64"), std::pair(Duration{-42580 - 54668 - 5 * 55560}, Duration{-42580 - 54668}));
  EXPECT_EQ(firstAndLast("QT128"), std::pair(Duration{9000 + 600 - 111'110}, Duration{9000 + 600}));
  EXPECT_EQ(firstAndLast("QT64"), std::pair(Duration{25710 + 12310}, Duration{25710 + 12310 + 3 * 166'667}));
}

TEST(HesaiDecoder, readsYearsCountedFrom1900OrFrom2000)
{
  auto packet = hesaiPacket(model("40P"), {});
  const Timestamp counted_from_1900 = blocksOf(decoderOf(model("40P")), packet)[0].stamp;
  packet[model("40P").tailAt() + model("40P").tail.date] = 23;
  EXPECT_EQ(blocksOf(decoderOf(model("40P")), packet)[0].stamp, counted_from_1900);
  packet[model("40P").tailAt() + model("40P").tail.date] = 216;
  EXPECT_FALSE(blocksOf(decoderOf(model("40P")), packet)[0].valid) << "2116 has no stamp of 62 bits";
}

TEST(HesaiDecoder, firesOneChannelAfterAnother)
{
  const PointCloud xt32 = pointsOf(decoderOf(model("XT32")), hesaiPacket(model("XT32"), {}), 3);
  for (std::size_t i = 0; i < 32; ++i) EXPECT_EQ(xt32.t[i], static_cast<int>(i) * 1512);
  const PointCloud xt32m = pointsOf(decoderOf(model("XT32M")), hesaiPacket(model("XT32M"), {}), 3);
  for (std::size_t i = 0; i < 32; ++i) EXPECT_EQ(xt32m.t[i], static_cast<int>(i % 16) * 2888);
}

TEST(HesaiDecoder, takesTheQt128sLoopByBlockOrWithTwoReturnsByItsFlag)
{
  const HesaiModel& qt128 = model("QT128");
  const auto thirdChannel = [](const PointCloud& points) { return points.t[34]; };
  const auto packet = hesaiPacket(qt128, {});
  EXPECT_EQ(thirdChannel(pointsOf(decoderOf(qt128), packet, 0)), 2312 - 600);
  EXPECT_EQ(thirdChannel(pointsOf(decoderOf(qt128), packet, 1)), 0) << "does not fire";
  HesaiContent two;
  two.return_mode = 0x39;
  auto dual = hesaiPacket(qt128, two);
  EXPECT_EQ(thirdChannel(pointsOf(decoderOf(qt128, 2), dual, 0)), 0);
  dual[qt128.tailAt() + qt128.tail.loop] = 1;
  EXPECT_EQ(thirdChannel(pointsOf(decoderOf(qt128, 2), dual, 0)), 2312 - 600);
}

TEST(HesaiDecoder, callsAnotherModelsPacketsForeignOrOfTheWrongSize)
{
  auto packet = hesaiPacket(model("XT32"), {});
  packet[2] = 1;
  EXPECT_EQ(decoderOf(model("XT32")).kind(packet), PacketKind::Foreign) << "another protocol";
  for (const HesaiModel& one : kHesaiModels)
    for (const HesaiModel& other : kHesaiModels)
      EXPECT_EQ(decoderOf(one).kind(hesaiPacket(other, {})) == PacketKind::Lidar, one.name == other.name);
}

struct HesaiMistake
{
  const char* name;
  nlohmann::json key;
  const char* says;
};
class HesaiMistakes : public testing::TestWithParam<HesaiMistake>
{
};
INSTANTIATE_TEST_SUITE_P(
    Keys, HesaiMistakes,
    testing::Values(HesaiMistake{"noModel", {{"model", nullptr}}, "model: is missing; known are 40P"},
                    HesaiMistake{"otherModel", {{"model", "AT128"}}, "'AT128' is unknown; known are 40P"},
                    HesaiMistake{"tooFewAngles", {{"vertical_angles_deg", {1, 2}}}, "must have 32 numbers"},
                    HesaiMistake{"noAngles", {{"vertical_angles_deg", nullptr}}, "or \"angles\": \"FILE.csv\""},
                    HesaiMistake{"noSuchFile", {{"angles", "none.csv"}}, "none.csv: metadata file can't be read"},
                    HesaiMistake{"threeReturns", {{"returns", 3}}, "returns: must be a whole number from 1 to 2"}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

TEST_P(HesaiMistakes, areSaidWithKeyAndCure)
{
  nlohmann::json json = nlohmann::json::parse(hesaiText(*findHesaiModel("XT32")));
  json.update(GetParam().key);
  try
  {
    parseHesaiMetadata(json.dump(), "folder/front.json");
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& e)
  {
    EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr("folder/"), testing::HasSubstr(GetParam().says)));
  }
}
}  // namespace scanloom::hesai_decoder_unittest
