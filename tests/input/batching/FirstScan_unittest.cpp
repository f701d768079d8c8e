#include "input/batching/internal/FirstScan.h"

#include <gtest/gtest.h>

namespace scanloom::first_scan_unittest
{
namespace
{
constexpr Duration kPeriod = 100ms, kPatience = 5ms;

LidarBeforeStart heard(Duration first_stamp) { return {Timestamp{first_stamp}, 1ms, kPatience}; }
LidarBeforeStart silent() { return {std::nullopt, Duration{0}, kPatience}; }
}  // namespace

TEST(FirstScan, startsAtTheNextMultipleOfThePeriodPlusThePhase)
{
  EXPECT_EQ(startAfter(Timestamp{70ms}, kPeriod, 0ms), Timestamp{100ms});
  EXPECT_EQ(startAfter(Timestamp{100ms}, kPeriod, 0ms), Timestamp{200ms}) << "eq. (1) adds a period on the grid, too";
  EXPECT_EQ(startAfter(Timestamp{20ms}, kPeriod, 37ms), Timestamp{37ms});
}

TEST(FirstScan, mayBeginWithTheFirstBlocksWhereItIsWhole)
{
  EXPECT_EQ(startOfWholeScan(Timestamp{100ms}, kPeriod, 0ms, 2ms), Timestamp{100ms});
  EXPECT_EQ(startOfWholeScan(Timestamp{101ms}, kPeriod, 0ms, 2ms), Timestamp{100ms});
  EXPECT_EQ(startOfWholeScan(Timestamp{102ms}, kPeriod, 0ms, 2ms), Timestamp{200ms}) << "a block was missed";
  EXPECT_EQ(startOfWholeScan(Timestamp{137ms}, kPeriod, 37ms, 2ms), Timestamp{137ms});
  EXPECT_EQ(startOfWholeScan(Timestamp{100ms}, kPeriod, 0ms, 0ms), Timestamp{200ms}) << "eq. (1)";
}

TEST(FirstScan, theLatestFirstStampIsCertainWhenNoEarlierPacketCanCome)
{
  EXPECT_EQ(latestFirstStamp({heard(30ms), heard(70ms)}, kPeriod, Timestamp{75ms}), std::nullopt);
  EXPECT_EQ(latestFirstStamp({heard(30ms), heard(70ms)}, kPeriod, Timestamp{76ms}), Timestamp{70ms});
}

TEST(FirstScan, aSilentLidarIsWaitedForOnePeriod)
{
  EXPECT_EQ(latestFirstStamp({heard(30ms), silent()}, kPeriod, Timestamp{135ms}), std::nullopt);
  EXPECT_EQ(latestFirstStamp({heard(30ms), silent()}, kPeriod, Timestamp{136ms}), Timestamp{30ms});
}

TEST(FirstScan, atTheEndOfInputNobodyIsWaitedFor)
{
  EXPECT_EQ(latestFirstStamp({heard(30ms), silent()}, kPeriod, std::nullopt), Timestamp{30ms});
  EXPECT_EQ(latestFirstStamp({silent()}, kPeriod, std::nullopt), std::nullopt);
}
}  // namespace scanloom::first_scan_unittest
