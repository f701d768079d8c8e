#include "base/core/unwrapped.h"

#include <gtest/gtest.h>

namespace scanloom::unwrapped_unittest
{
TEST(Unwrapped, stampsOfTheHourGoOnAfterIt)
{
  EXPECT_EQ(unwrapped(Timestamp{3599s}, 1h, Timestamp{1750003198s}), Timestamp{1750003199s});  // 486111.999 h
  EXPECT_EQ(unwrapped(Timestamp{1s}, 1h, Timestamp{1750003201s}), Timestamp{1750003201s});
  EXPECT_EQ(unwrapped(Timestamp{1s}, 0h, Timestamp{1750003201s}), Timestamp{1s});
}
}  // namespace scanloom::unwrapped_unittest
