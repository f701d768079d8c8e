#include "base/config/Names.h"

#include <gtest/gtest.h>

namespace scanloom::names_unittest
{
namespace
{
TEST(Names, areAsFarApartAsEditsAreNeeded)
{
  EXPECT_EQ(editDistance("kitten", "sitting"), 3U);
  EXPECT_EQ(editDistance("", "abc"), 3U);
  EXPECT_EQ(editDistance("Cell_Size", "cell_size"), 0U);
}

TEST(Names, areSuggestedIfTheyAreNear)
{
  EXPECT_EQ(suggestion("slma", {"record", "slam", "map"}), "did you mean 'slam'?");
  EXPECT_EQ(suggestion("everything", {"record", "slam", "map"}), "known are 'record', 'slam' and 'map'");
  EXPECT_EQ(suggestion("slam", {}), "");
}

TEST(Names, areSuggestedWithTheirWordsInAnotherOrder)
{
  EXPECT_EQ(suggestion("range_max", {"min_x", "min_range", "max_range"}), "did you mean 'max_range'?");
}

TEST(Names, areSuggestedIfTheyContainWhatIsWritten)
{
  EXPECT_EQ(suggestion("pcap", {"driver", "pcap_input", "pcap_output"}), "did you mean 'pcap_input' or 'pcap_output'?");
}

TEST(Names, areNotAllListedIfTheyAreMany)
{
  const std::vector<std::string> many{"a1", "a2", "a3", "a4", "a5", "a6", "a7", "a8", "a9", "a10", "crop"};
  EXPECT_EQ(suggestion("drop_everything", many), "the nearest of 11 known names is 'crop'");
}

}  // namespace
}  // namespace scanloom::names_unittest
