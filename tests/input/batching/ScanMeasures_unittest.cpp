#include "support/ScanMeasures.h"

#include <gtest/gtest.h>

namespace scanloom::scan_measures_unittest
{
TEST(ScanMeasures, theSpanIsBetweenTheOldestAndTheNewestColumnWhateverTheirOrder)
{
  Scan scan;
  EXPECT_EQ(spanOf(scan), Duration{0});
  for (const auto stamp : {130ms, 20ms, 90ms})
  {
    Column column;
    column.stamp = Timestamp{stamp};
    scan.columns.push_back(column);
  }
  EXPECT_EQ(spanOf(scan), Duration{110ms});
}

TEST(ScanMeasures, theExtentIsThatOfTheChosenPointsAlongTheDirection)
{
  PointCloud cloud;
  cloud.resize(4);
  for (std::size_t i = 0; i < 4; ++i)
  {
    cloud.x[i] = static_cast<float>(i * i);
    cloud.y[i] = 7;
  }
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), diagonal = Eigen::Vector3d(1, 1, 0).normalized();
  EXPECT_DOUBLE_EQ(extentAlong(x, cloud, {2, 1, 3}), 8);
  EXPECT_DOUBLE_EQ(extentAlong(diagonal, cloud, {0, 1, 2, 3}), 9 / std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(extentAlong(Eigen::Vector3d::UnitY(), cloud, {0, 3}), 0);
  EXPECT_DOUBLE_EQ(extentAlong(x, cloud, {}), 0);
}
}  // namespace scanloom::scan_measures_unittest
