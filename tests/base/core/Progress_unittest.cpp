#include "base/core/Progress.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace scanloom::progress_unittest
{
namespace
{
using testing::HasSubstr;
using testing::MatchesRegex;

std::vector<std::string> linesOf(const std::string& text)
{
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Progress, writesALinePerTenPercentWhereThereIsNoTerminal)
{
  std::ostringstream out;
  {
    Progress progress("slam", 250, "scans", out, false);
    for (int i = 0; i <= 250; ++i) progress.update(i);
  }
  const auto lines = linesOf(out.str());

  ASSERT_EQ(lines.size(), 10U);
  EXPECT_THAT(lines[0], MatchesRegex("slam: 10 %, 25/250 scans, .* scans/s, .* left"));
  EXPECT_THAT(lines[9], MatchesRegex("slam: 100 %, 250/250 scans, .* scans/s, took 0 s"));
}

TEST(Progress, saysHowFarAnInterruptedRunCame)
{
  std::ostringstream out;
  {
    Progress progress("slam", 100, "scans", out, false);
    progress.update(15);
    progress.update(17);
  }
  const auto lines = linesOf(out.str());

  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines[1], HasSubstr("17 %, 17/100 scans"));
}

TEST(Progress, fits80ColumnsOfATerminal)
{
  std::ostringstream out;
  {
    Progress progress("experiment", 123456789, "MB", out, true);
    progress.update(12345678);
  }
  for (std::size_t begin = 0; begin < out.str().size();)
  {
    const std::size_t end = std::min(out.str().find_first_of("\r\n", begin), out.str().size());
    EXPECT_LE(end - begin, std::string("\033[K").size() + 79) << out.str().substr(begin, end - begin);
    begin = end + 1;
  }
}

TEST(Progress, saysAWarningAboveItsLine)
{
  std::ostringstream out;
  Progress progress("slam", 100, "scans", out, true);
  progress.update(15);
  progress.say("warning: low disk");
  EXPECT_THAT(out.str(), HasSubstr("\r\033[Kwarning: low disk\n"));
  EXPECT_THAT(out.str(), testing::Not(testing::EndsWith("\n"))) << "the line is there again";
}

TEST(Progress, drawsABarOnOneLineOfATerminal)
{
  std::ostringstream out;
  {
    Progress progress("slam", 4, "scans", out, true);
    progress.update(2);
  }
  ASSERT_EQ(linesOf(out.str()).size(), 1U);
  EXPECT_THAT(out.str(), HasSubstr("\r\033[Kslam: [==========          ] 50 %, 2/4 scans, "));
  EXPECT_EQ(out.str().back(), '\n');
}

TEST(Progress, countsWithoutAnEnd)
{
  std::ostringstream out;
  {
    Progress progress("record", 0, "scans", out, false);
    progress.update(7);
  }
  EXPECT_THAT(out.str(), MatchesRegex("record: 7 scans, .* scans/s\n"));
}

TEST(MegabytesOf, countsFilesOfFoldersAndNoMissingOnes)
{
  const TemporaryFolder folder;
  for (const char* name : {"a", "b"}) std::ofstream(folder / name) << std::string(1'500'000, 'x');
  EXPECT_EQ(megabytesOf({folder.path()}), 3U);
  EXPECT_EQ(megabytesOf({folder / "a", folder / "b", folder / "missing"}), 3U);
  EXPECT_EQ(megabytesOf({folder / "missing"}), 1U);
}

TEST(TimeText, isShort)
{
  EXPECT_EQ(timeText(-1), "0 s");
  EXPECT_EQ(timeText(59.4), "59 s");
  EXPECT_EQ(timeText(59.6), "1:00 min");
  EXPECT_EQ(timeText(247), "4:07 min");
  EXPECT_EQ(timeText(7500), "2:05 h");
}
}  // namespace
}  // namespace scanloom::progress_unittest
