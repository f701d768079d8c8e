#include "base/core/Finding.h"

#include <gtest/gtest.h>

#include <sstream>

namespace scanloom::finding_unittest
{
namespace
{
const std::string kLong =
    "a sentence that is so long that it does not fit into one line of a terminal and has to be continued in the next";
}

TEST(Finding, theWorstDecides)
{
  EXPECT_EQ(worstOf({}), Verdict::Ok);
  EXPECT_EQ(worstOf({{"a", "m", Verdict::NotMeasured, "", ""}, {"a", "m", Verdict::Warning, "", ""}}),
            Verdict::Warning);
  EXPECT_EQ(worstOf({{"a", "m", Verdict::NotFit, "", ""}, {"a", "m", Verdict::Ok, "", ""}}), Verdict::NotFit);
}

TEST(Finding, theSummaryCounts)
{
  const Finding ok{"a", "m", Verdict::Ok, "", ""}, warning{"a", "m", Verdict::Warning, "", ""};
  const Finding bad{"a", "m", Verdict::NotFit, "", ""};
  EXPECT_EQ(summaryOf({ok}), "fit for SLAM");
  EXPECT_EQ(summaryOf({ok, warning}), "fit for SLAM, 1 warning");
  EXPECT_EQ(summaryOf({bad, warning, warning, bad}), "NOT FIT for SLAM for 2 reasons, 2 warnings");
}

TEST(Finding, tablesFitTheWidthAndLoseNoWord)
{
  const Findings findings{{"left", "loss", Verdict::Warning, kLong, kLong}, {"right", "loss", Verdict::Ok, "none", ""}};
  std::string words;
  std::istringstream lines(toText(findings));
  for (std::string line; std::getline(lines, line);)
  {
    EXPECT_LE(line.size(), 100u) << line;
    std::istringstream in(line);
    for (std::string word; in >> word;) words += word + ' ';
  }
  EXPECT_EQ(words, "left warning loss " + kLong + " -> " + kLong + " right ok loss none ");
}
}  // namespace scanloom::finding_unittest
