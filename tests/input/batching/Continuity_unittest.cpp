#include "input/batching/Continuity.h"

#include <gtest/gtest.h>

namespace scanloom::continuity_unittest
{
namespace
{
using Verdict = Continuity::Verdict;

constexpr int kTurn = 64, kPacket = 16;
constexpr Duration kPacketTime = 25ms;

LidarDescription lidar(Numbering numbering = Numbering::Ids)
{
  LidarDescription d;
  d.columns_per_frame = kTurn;
  d.columns_per_packet = kPacket;
  d.last_column = kTurn - 1;
  d.frame_rate = 10;
  d.frame_id_modulus = 65536;
  d.numbering = numbering;
  return d;
}

/** Packet `number` of a lidar whose frame ids begin at `first_frame`; its stamps are `clock` ahead of host time. */
struct Stream
{
  std::int64_t first_frame = 100;
  Duration clock{0};
  std::optional<std::uint32_t> init_id{};

  PacketPlace place(std::int64_t number) const
  {
    PacketPlace place;
    const std::int64_t block = first_frame * kTurn + number * kPacket + kPacket - 1;
    place.init_id = init_id;
    place.frame_id = static_cast<std::uint32_t>((block / kTurn) % 65536);
    place.measurement_id = static_cast<std::uint16_t>(block % kTurn);
    place.stamp = Timestamp{1000s + clock + number * kPacketTime};
    return place;
  }
};

Timestamp arrival(std::int64_t number) { return Timestamp{1000s + 200us + number * kPacketTime}; }

Continuity heard(const Stream& stream, std::int64_t packets, Numbering numbering = Numbering::Ids)
{
  Continuity continuity(lidar(numbering));
  for (std::int64_t i = 0; i < packets; ++i)
    EXPECT_EQ(continuity.judge(stream.place(i), arrival(i)).verdict, Verdict::Continues);
  return continuity;
}
}  // namespace

TEST(Continuity, numbersBlocksThroughAWrapOfTheFrameIds)
{
  const Stream stream{65534};
  Continuity continuity = heard(stream, 8);
  const auto before = continuity.judge(stream.place(8), arrival(8));
  EXPECT_EQ(before.verdict, Verdict::Continues);
  EXPECT_EQ(continuity.judge(stream.place(9), arrival(9)).block, before.block + kPacket);
}

TEST(Continuity, aMinuteOfSilenceIsNoRestart)
{
  const Stream stream;
  Continuity continuity = heard(stream, 4);
  EXPECT_EQ(continuity.judge(stream.place(2404), arrival(2404)).verdict, Verdict::Continues);
}

TEST(Continuity, frameIdsMayGoRoundDuringSilence)
{
  const Stream stream;
  Continuity continuity = heard(stream, 4);
  const std::int64_t two_rounds_later = 4 * 2 * 65536 + 6;
  const auto judged = continuity.judge(stream.place(two_rounds_later), arrival(two_rounds_later));
  EXPECT_EQ(judged.verdict, Verdict::Continues);
  EXPECT_EQ(judged.block, 100 * kTurn + two_rounds_later * kPacket + kPacket - 1);
}

TEST(Continuity, aDamagedFrameIdIsDoubtfulAndChangesNothing)
{
  const Stream stream;
  Continuity continuity = heard(stream, 4);
  PacketPlace damaged = stream.place(4);
  damaged.frame_id ^= 1u << 13;
  EXPECT_EQ(continuity.judge(damaged, arrival(4)).verdict, Verdict::Doubtful);
  EXPECT_EQ(continuity.judge(stream.place(5), arrival(5)).verdict, Verdict::Continues);
}

TEST(Continuity, aDamagedStampIsDoubtfulAndChangesNothing)
{
  const Stream stream;
  Continuity continuity = heard(stream, 4);
  PacketPlace damaged = stream.place(4);
  *damaged.stamp += 37s;
  EXPECT_EQ(continuity.judge(damaged, arrival(4)).verdict, Verdict::Doubtful);
  EXPECT_EQ(continuity.judge(stream.place(5), arrival(5)).verdict, Verdict::Continues);
}

TEST(Continuity, aClockThatStepsIsBelievedAtTheSecondPacketAndTheStepIsExact)
{
  for (const Duration step : {Duration{37s}, Duration{-37s}, Duration{1s}, Duration{5ms}, Duration{-5ms}})
  {
    const Stream before, after{100, step};
    Continuity continuity = heard(before, 40);
    EXPECT_EQ(continuity.judge(after.place(40), arrival(40)).verdict, Verdict::Doubtful);
    const auto judged = continuity.judge(after.place(41), arrival(41));
    EXPECT_EQ(judged.verdict, Verdict::ClockSteps);
    EXPECT_NEAR(seconds(judged.step), seconds(step), 1e-6);
    EXPECT_EQ(continuity.judge(after.place(42), arrival(42)).verdict, Verdict::Continues);
  }
}

TEST(Continuity, idsThatBeginAnewAreARestartWithOrWithoutInitId)
{
  const Stream before{5000}, after{-25, -1000s};  // packet 100 is the first one of frame 0
  Continuity continuity = heard(before, 40);
  EXPECT_EQ(continuity.judge(after.place(101), arrival(101)).verdict, Verdict::Doubtful);
  const auto judged = continuity.judge(after.place(102), arrival(102));
  EXPECT_EQ(judged.verdict, Verdict::Restarts);
  EXPECT_EQ(judged.first_block, judged.block - kPacket);

  const Stream run1{5000, 0s, 1}, run2{5000, 0s, 2};  // the same ids, another run
  Continuity with_init_id = heard(run1, 40);
  EXPECT_EQ(with_init_id.judge(run2.place(40), arrival(40)).verdict, Verdict::Doubtful);
  EXPECT_EQ(with_init_id.judge(run2.place(41), arrival(41)).verdict, Verdict::Restarts);
}

TEST(Continuity, measuresTheBlockPeriodOfARotorThatIsNotNominal)
{
  Continuity continuity(lidar());
  const Stream stream;
  for (std::int64_t i = 0; i < 400; ++i)
  {
    PacketPlace place = stream.place(i);
    place.stamp = Timestamp{1000s + i * kPacketTime * 1003 / 1000};
    ASSERT_EQ(continuity.judge(place, *place.stamp + 1ms).verdict, Verdict::Continues);
  }
  EXPECT_NEAR(seconds(continuity.blockPeriod()) / seconds(kPacketTime / kPacket), 1.003, 1e-4);
}

TEST(Continuity, withoutIdsLossShowsInTheStamps)
{
  const Stream stream;
  Continuity continuity = heard(stream, 4, Numbering::Stamps);
  const auto before = continuity.judge(stream.place(4), arrival(4));
  EXPECT_EQ(continuity.judge(stream.place(8), arrival(8)).block, before.block + 4 * kPacket);
}

TEST(Continuity, withoutIdsAStepShowsAgainstHostTime)
{
  const Stream before, after{100, 37s};
  Continuity continuity = heard(before, 4, Numbering::Stamps);
  EXPECT_EQ(continuity.judge(after.place(4), arrival(4)).verdict, Verdict::Doubtful);
  const auto judged = continuity.judge(after.place(5), arrival(5));
  EXPECT_EQ(judged.verdict, Verdict::ClockSteps);
  EXPECT_NEAR(seconds(judged.step), 37, 1e-3);
}
}  // namespace scanloom::continuity_unittest
