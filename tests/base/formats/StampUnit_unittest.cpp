#include "base/formats/StampUnit.h"

#include <gtest/gtest.h>

#include <string>

namespace scanloom::stamp_unit_unittest
{
namespace
{
TEST(StampUnit, byPaceIsThatOfASensor)
{
  const auto nameOf = [](double step) { return std::string(unitByPace(step, 200us, 100ms).value().name); };
  EXPECT_EQ(nameOf(5'000'000), "ns");  // 200 Hz
  EXPECT_EQ(nameOf(5'000), "us");
  EXPECT_EQ(nameOf(5), "ms");
  EXPECT_FALSE(unitByPace(0.5, 1s, 2s));
}

TEST(StampUnit, byDateIsOneSince1980)
{
  const auto nameOf = [](std::int64_t stamp) { return std::string(unitByDate(stamp).value().name); };
  EXPECT_EQ(nameOf(1'700'000'000), "s");
  EXPECT_EQ(nameOf(1'700'000'000'000), "ms");
  EXPECT_EQ(nameOf(1'700'000'000'000'000), "us");
  EXPECT_EQ(nameOf(1'700'000'000'000'000'000), "ns");
  EXPECT_FALSE(unitByDate(42));
  EXPECT_FALSE(unitByDate(-1));
}

TEST(StampUnit, noStampIsFartherThanDifferencesCanBe)
{
  constexpr StampUnit kSeconds{"s", 1'000'000'000};
  EXPECT_EQ(kSeconds.stampOf(3), Timestamp{3s});
  EXPECT_FALSE(kSeconds.stampOf(5'000'000'000));
  EXPECT_FALSE(kSeconds.stampOf(-5'000'000'000));
}
}  // namespace
}  // namespace scanloom::stamp_unit_unittest
