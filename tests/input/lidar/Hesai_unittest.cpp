#include "input/lidar/internal/Hesai.h"

#include <gtest/gtest.h>

#include "hesaiPackets.h"

namespace scanloom::hesai_unittest
{
namespace
{
constexpr Timestamp kStamp{1'677'673'815'500'000'000ns};  // 2023-03-01 12:30:15.5

const HesaiModel& model(const char* name) { return modelNamed(kHesaiModels, name); }
}  // namespace

class EveryHesai : public testing::TestWithParam<HesaiModel>
{
 protected:
  const HesaiModel model = GetParam();
  const std::unique_ptr<PacketDecoder> decoder = hesaiDecoder(model);
};
INSTANTIATE_TEST_SUITE_P(Models, EveryHesai, testing::ValuesIn(kHesaiModels),
                         [](const auto& row) { return std::string(row.param.name); });

TEST_P(EveryHesai, refusesWhatIsNotItsOwn)
{
  auto packet = hesaiPacket(model, {});
  packet[model.tailAt() + model.tail.return_mode] = 0x3D;
  EXPECT_EQ(decoder->kind(packet), PacketKind::Malformed) << "three returns";
  packet = hesaiPacket(model, {});
  packet[0] = 0;
  EXPECT_EQ(decoder->kind(packet), PacketKind::Malformed) << "no marker";
  EXPECT_EQ(decoder->kind(std::vector<std::uint8_t>(512)), PacketKind::Other) << "a position packet";
}

TEST_P(EveryHesai, callsDatesAndAnglesThatThereAreNotInvalid)
{
  HesaiContent content;
  content.month = 13;
  EXPECT_FALSE(blocksOf(*decoder, hesaiPacket(model, content))[0].valid);
  EXPECT_TRUE(pointsOf(*decoder, hesaiPacket(model, content), 0).empty());
  auto packet = hesaiPacket(model, {});
  store(packet, model.header_bytes + model.azimuth_at, std::uint16_t{36001});
  EXPECT_FALSE(blocksOf(*decoder, packet)[0].valid);
  EXPECT_TRUE(blocksOf(*decoder, packet)[1].valid);
}

TEST(Hesai, stampsTheFirstShotInUtc)
{
  // The manuals' tables of block times, plus the earliest channel's.
  const auto firstAndLast = [](const char* name)
  {
    const auto blocks = blocksOf(*hesaiDecoder(model(name)), hesaiPacket(model(name), {}));
    return std::pair{blocks.front().stamp - kStamp, blocks.back().stamp - kStamp};
  };
  EXPECT_EQ(firstAndLast("XT32"), std::pair(Duration{5632 + 368 - 350'000}, Duration{5632 + 368}));
  EXPECT_EQ(firstAndLast("40P"), std::pair(Duration{-28580 - 54670 - 9 * 55560}, Duration{-28580 - 54670}));
  EXPECT_EQ(firstAndLast("64"), std::pair(Duration{-42580 - 54668 - 5 * 55560}, Duration{-42580 - 54668}));
  EXPECT_EQ(firstAndLast("QT128"), std::pair(Duration{9000 + 600 - 111'110}, Duration{9000 + 600}));
  EXPECT_EQ(firstAndLast("QT64"), std::pair(Duration{25710 + 12310}, Duration{25710 + 12310 + 3 * 166'667}));
}

TEST(Hesai, readsYearsCountedFrom1900OrFrom2000)
{
  auto packet = hesaiPacket(model("40P"), {});
  const Timestamp counted_from_1900 = blocksOf(*hesaiDecoder(model("40P")), packet)[0].stamp;
  packet[model("40P").tailAt() + model("40P").tail.date] = 23;
  EXPECT_EQ(blocksOf(*hesaiDecoder(model("40P")), packet)[0].stamp, counted_from_1900);
  packet[model("40P").tailAt() + model("40P").tail.date] = 216;
  EXPECT_FALSE(blocksOf(*hesaiDecoder(model("40P")), packet)[0].valid) << "2116 has no stamp of 62 bits";
}

TEST(Hesai, firesOneChannelAfterAnother)
{
  const PointCloud xt32 = pointsOf(*hesaiDecoder(model("XT32")), hesaiPacket(model("XT32"), {}), 3);
  for (std::size_t i = 0; i < 32; ++i) EXPECT_EQ(xt32.t[i], static_cast<int>(i) * 1512);
  const PointCloud xt32m = pointsOf(*hesaiDecoder(model("XT32M")), hesaiPacket(model("XT32M"), {}), 3);
  for (std::size_t i = 0; i < 32; ++i) EXPECT_EQ(xt32m.t[i], static_cast<int>(i % 16) * 2888);
}

TEST(Hesai, takesTheQt128sLoopByBlockOrWithTwoReturnsByItsFlag)
{
  const HesaiModel& qt128 = model("QT128");
  const auto thirdChannel = [](const PointCloud& points) { return points.t[34]; };
  const auto packet = hesaiPacket(qt128, {});
  EXPECT_EQ(thirdChannel(pointsOf(*hesaiDecoder(qt128), packet, 0)), 2312 - 600);
  EXPECT_EQ(thirdChannel(pointsOf(*hesaiDecoder(qt128), packet, 1)), 0) << "does not fire";
  HesaiContent two;
  two.return_mode = 0x39;
  auto dual = hesaiPacket(qt128, two);
  EXPECT_EQ(thirdChannel(pointsOf(*hesaiDecoder(qt128, 2), dual, 0)), 0);
  dual[qt128.tailAt() + qt128.tail.loop] = 1;
  EXPECT_EQ(thirdChannel(pointsOf(*hesaiDecoder(qt128, 2), dual, 0)), 2312 - 600);
}

TEST(Hesai, callsAnotherModelsPacketsForeignOrOfTheWrongSize)
{
  auto packet = hesaiPacket(model("XT32"), {});
  packet[2] = 1;
  EXPECT_EQ(hesaiDecoder(model("XT32"))->kind(packet), PacketKind::Foreign) << "another protocol";
  for (const HesaiModel& one : kHesaiModels)
    for (const HesaiModel& other : kHesaiModels)
      EXPECT_EQ(hesaiDecoder(one)->kind(hesaiPacket(other, {})) == PacketKind::Lidar, one.name == other.name);
}
}  // namespace scanloom::hesai_unittest
