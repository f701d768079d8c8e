#include "input/rig/RepeatedWarnings.h"

#include <gmock/gmock.h>

namespace scanloom::repeated_warnings_unittest
{
using namespace std::chrono_literals;
using testing::ElementsAre;

TEST(RepeatedWarnings, areSaidOnceAMinuteWithTheirNumber)
{
  RepeatedWarnings warnings;
  const auto start = RepeatedWarnings::Clock::now();
  std::vector<std::string> said;
  for (int second = 0; second < 130; ++second)
    if (const auto text = warnings.toSay("lidar 'left': back after 0.3 s", start + second * 1s)) said.push_back(*text);
  EXPECT_THAT(said, ElementsAre("lidar 'left': back after 0.3 s",
                                "lidar 'left': back after 0.3 s (60 times since the last such line)",
                                "lidar 'left': back after 0.3 s (60 times since the last such line)"));
  EXPECT_THAT(warnings.unsaid(), ElementsAre("lidar 'left': back after 0.3 s (9 times since the last such line)"));
  EXPECT_TRUE(warnings.unsaid().empty());
}

TEST(RepeatedWarnings, areTheSameIfOnlyNumbersDiffer)
{
  RepeatedWarnings warnings;
  EXPECT_TRUE(warnings.toSay("back after 0.31 s"));
  EXPECT_FALSE(warnings.toSay("back after 12.7 s"));
  EXPECT_TRUE(warnings.toSay("silent"));
  EXPECT_THAT(warnings.unsaid(), ElementsAre("back after 12.7 s"));
}
}  // namespace scanloom::repeated_warnings_unittest
