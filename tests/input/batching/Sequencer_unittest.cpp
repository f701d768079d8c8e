#include "input/batching/internal/Sequencer.h"

#include <gtest/gtest.h>

namespace scanloom::sequencer_unittest
{
namespace
{
LidarDescription lidar(int first_column = 0, int last_column = 63)
{
  LidarDescription d;
  d.columns_per_frame = 64;
  d.columns_per_packet = 16;
  d.first_column = first_column;
  d.last_column = last_column;
  d.frame_rate = 10;
  d.frame_id_modulus = 65536;
  return d;
}

/** By its last column, which is read at `stamp`. */
Sequencer::Place packet(std::int64_t frame, std::int64_t column, Duration stamp)
{
  return {frame * 64 + column, Timestamp{stamp}, 1562500ns};
}
}  // namespace

TEST(PacketNumbering, countsOnlyThePacketsThatAWindowLetsOut)
{
  const PacketNumbering numbering(lidar(20, 40));  // packets 1 and 2 of 0 to 3
  EXPECT_EQ(numbering.sentBefore(4) - numbering.sentBefore(0), 2);
  EXPECT_EQ(numbering.sentBefore(5) - numbering.sentBefore(3), 0);
  EXPECT_EQ(numbering.sentBefore(-1), -2 + 2);
}

TEST(PacketNumbering, aWindowMayWrapAroundZero)
{
  const PacketNumbering numbering(lidar(50, 10));  // packets 0 and 3
  EXPECT_EQ(numbering.sentBefore(3) - numbering.sentBefore(1), 0);
  EXPECT_EQ(numbering.blocksToNext(10), 40);
  EXPECT_EQ(numbering.blocksToNext(63), 1);
}

TEST(Sequencer, theWatermarkWaitsAtAGapUntilTheMissingPacketComes)
{
  Sequencer sequencer(lidar(), 5ms);
  sequencer.accept(packet(7, 15, 25ms), Timestamp{25ms});
  sequencer.accept(packet(7, 47, 75ms), Timestamp{75ms});
  EXPECT_LT(*sequencer.watermark(), Timestamp{27ms});
  EXPECT_EQ(sequencer.accept(packet(7, 31, 50ms), Timestamp{76ms}), Sequencer::Verdict::New);
  EXPECT_GT(*sequencer.watermark(), Timestamp{75ms});
}

TEST(Sequencer, aGapIsGivenUpAfterTheDeadlineAndWhatComesLaterIsRecovered)
{
  Sequencer sequencer(lidar(), 5ms);
  sequencer.accept(packet(7, 15, 25ms), Timestamp{25ms});
  sequencer.accept(packet(7, 63, 100ms), Timestamp{100ms});
  EXPECT_EQ(sequencer.giveUpGaps(Timestamp{104ms}), 0u);
  EXPECT_EQ(sequencer.giveUpGaps(Timestamp{105ms}), 2u);
  EXPECT_GT(*sequencer.watermark(), Timestamp{100ms});
  EXPECT_EQ(sequencer.accept(packet(7, 31, 50ms), Timestamp{106ms}), Sequencer::Verdict::Recovered);
}

TEST(Sequencer, aPacketIsTakenOnce)
{
  Sequencer sequencer(lidar(), 5ms);
  EXPECT_EQ(sequencer.accept(packet(7, 15, 25ms), Timestamp{25ms}), Sequencer::Verdict::New);
  EXPECT_EQ(sequencer.accept(packet(7, 31, 50ms), Timestamp{50ms}), Sequencer::Verdict::New);
  EXPECT_EQ(sequencer.accept(packet(7, 15, 25ms), Timestamp{51ms}), Sequencer::Verdict::Duplicate);
}

TEST(Sequencer, afterTheWindowTheWatermarkJumpsToTheNextTurn)
{
  Sequencer sequencer(lidar(0, 15), 5ms);
  sequencer.accept(packet(7, 15, 25ms), Timestamp{25ms});
  EXPECT_GT(*sequencer.watermark(), Timestamp{100ms});
  EXPECT_LT(*sequencer.watermark(), Timestamp{25ms + 49 * 1562500ns});  // the next turn's first block
}

TEST(Sequencer, aStepOfTheClockMovesTheWatermark)
{
  Sequencer sequencer(lidar(), 5ms);
  sequencer.accept(packet(7, 15, 25ms), Timestamp{25ms});
  const Timestamp before = *sequencer.watermark();
  sequencer.shift(37s);
  EXPECT_EQ(*sequencer.watermark() - before, 37s);
}

TEST(Sequencer, aRestartCountsWhatWasMissingAndForgetsTheRest)
{
  Sequencer sequencer(lidar(), 5ms);
  sequencer.accept(packet(7, 15, 25ms), Timestamp{25ms});
  sequencer.accept(packet(7, 47, 75ms), Timestamp{75ms});
  EXPECT_EQ(sequencer.restart(0), 1u);
  EXPECT_FALSE(sequencer.watermark());
  EXPECT_EQ(sequencer.finish(), 0u);
}
}  // namespace scanloom::sequencer_unittest
