#include "base/core/PointCloud.h"

#include <gtest/gtest.h>

namespace scanloom::point_cloud_unittest
{
namespace
{
/** Every field of every point has a different value. */
PointCloud numbered(std::size_t points, int from)
{
  PointCloud cloud;
  cloud.resize(points);
  int value = from;
  forEachField(cloud,
               [&value](auto& field)
               {
                 for (auto& element : field) element = static_cast<std::decay_t<decltype(element)>>(value++);
               });
  return cloud;
}
}  // namespace

TEST(PointCloud, appendingACloudIsAppendingItsPoints)
{
  const PointCloud other = numbered(7, 50);
  PointCloud whole = numbered(3, 1), one_by_one = whole;
  whole.append(other);
  for (std::size_t i = 0; i < other.size(); ++i) one_by_one.append(other, i);

  ASSERT_EQ(whole.size(), 10u);
  std::vector<std::vector<double>> fields[2];
  for (const PointCloud* cloud : {&whole, &one_by_one})
    forEachField(*cloud, [&](const auto& field) { fields[cloud == &whole].emplace_back(field.begin(), field.end()); });
  EXPECT_EQ(fields[0], fields[1]);
  EXPECT_EQ(fields[0].size(), 11u);
}
}  // namespace scanloom::point_cloud_unittest
