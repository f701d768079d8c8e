#include "base/core/internal/DurationHistogram.h"

#include <gtest/gtest.h>

namespace scanloom::duration_histogram_unittest
{
namespace
{
TEST(DurationHistogram, tellsQuantilesToFivePercentOverSevenDecades)
{
  for (const double scale : {1e-2, 1.0, 1e2, 6e3})
  {
    DurationHistogram histogram;
    for (int i = 1; i <= 1000; ++i) histogram.add(scale * i / 100);

    EXPECT_NEAR(histogram.quantile(0.5), 5 * scale, 0.05 * 5 * scale);
    EXPECT_NEAR(histogram.quantile(0.95), 9.5 * scale, 0.05 * 9.5 * scale);
  }
}

TEST(DurationHistogram, hasAQuantileOfOneAndNoneOfNothing)
{
  DurationHistogram histogram;
  EXPECT_EQ(histogram.quantile(0.95), 0);

  histogram.add(20);

  EXPECT_NEAR(histogram.quantile(0.01), 20, 1);
  EXPECT_NEAR(histogram.quantile(1), 20, 1);
}

TEST(DurationHistogram, takesWhatIsOutOfItsRangeForItsEnds)
{
  DurationHistogram histogram;
  histogram.add(0);
  histogram.add(1e9);

  EXPECT_LT(histogram.quantile(0.5), 2e-3);
  EXPECT_NEAR(histogram.quantile(1), 67e3, 5e3);
}
}  // namespace
}  // namespace scanloom::duration_histogram_unittest
