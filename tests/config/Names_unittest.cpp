#include "config/Names.h"

#include <gtest/gtest.h>

namespace scanloom
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

TEST(Names, loseBlanksAtBothEnds)
{
  EXPECT_EQ(trimmed(" \t a b \r\n"), "a b");
  EXPECT_EQ(trimmed(" \n"), "");
}
}  // namespace
}  // namespace scanloom
