#include "estimation/ndt/internal/RingSpread.h"

#include "RayWorld.h"
#include "base/core/Angle.h"
#include "estimation/ndt/NdtMap.h"

#include <gtest/gtest.h>

namespace scanloom::ring_spread_unittest
{
namespace
{
constexpr double kSpacing = 2 * kDegree;
const Rings kUpright{Eigen::Vector3d::UnitZ(), kSpacing};

/** Points on the wall x = `away`, in one column of cells of 1 m; seen from the origin. */
View wallSeen(double away, const std::vector<double>& heights)
{
  View view{{}, Eigen::Vector3d::Zero(), kUpright};
  for (const double z : heights)
    for (double y = -0.45; y < 0.5; y += 0.1) view.points.push_back(Eigen::Vector3d(away, y + 0.5, z).cast<float>());
  return view;
}

/** Points on the ground z = 0 at these distances, seen from 2 m above it. */
View groundSeen(const std::vector<double>& distances)
{
  View view{{}, Eigen::Vector3d(0, 0, 2), kUpright};
  for (const double x : distances)
    for (double y = -0.45; y < 0.5; y += 0.1) view.points.push_back(Eigen::Vector3d(x, y + 0.5, 0.01).cast<float>());
  return view;
}

GaussianCell cellOf(const View& view) { return NdtMap({view}, {}).cells().front(); }

double varianceOfGap(double width) { return width * width / 12; }
}  // namespace

TEST(RingSpread, aLevelLineOnAWallIsAsHighAsTheGapBetweenRings)
{
  const GaussianCell cell = cellOf(wallSeen(20.5, {0.4, 1.1, 1.82, 2.53}));
  EXPECT_NEAR(cell.covariance(2, 2), varianceOfGap(kSpacing * 20.5), 2e-4);
  EXPECT_NEAR(cell.covariance(0, 0), 0.03 * 0.03, 1e-4) << "the wall stays thin";
  EXPECT_NEAR(cell.mean.z(), 0.4, 1e-3);
}

TEST(RingSpread, aGapThatIsWiderThanTheCellFillsIt)
{
  EXPECT_NEAR(cellOf(wallSeen(40.5, {0.1, 1.5, 2.9})).covariance(2, 2), varianceOfGap(1), 1e-3);
}

TEST(RingSpread, groundBetweenRingsIsWideAlongItselfAndStaysThin)
{
  // From 2 m above, beams 9, 11 and 13 deg below the horizon.
  const GaussianCell cell =
      cellOf(groundSeen({2 / std::tan(13 * kDegree), 2 / std::tan(11 * kDegree), 2 / std::tan(9 * kDegree)}));
  EXPECT_GT(cell.covariance(0, 0), varianceOfGap(0.9));
  EXPECT_NEAR(cell.covariance(2, 2), 0.03 * 0.03, 1e-3);
}

TEST(RingSpread, aSingleRingSaysNothingOfTheSlopeOfItsSurface)
{
  const GaussianCell cell = cellOf(groundSeen({16.5}));
  const Eigen::Vector3d view = (cell.mean - Eigen::Vector3d(0, 0, 2)).normalized();
  EXPECT_GT(view.dot(cell.covariance * view), varianceOfGap(0.9));
  EXPECT_GT(cell.covariance(2, 2), varianceOfGap(kSpacing * 16));
}

TEST(RingSpread, aCellOfManyRingsStays)
{
  const View view = wallSeen(5.5, {0.1, 0.3, 0.5, 0.7, 0.9});
  View plain = view;
  plain.rings.reset();
  EXPECT_EQ(cellOf(view).covariance, cellOf(plain).covariance);
}

TEST(RingSpread, ringsOfATiltedLidarAreWidenedAcrossItsAxis)
{
  View view = wallSeen(10.5, {0.1});
  const Rigid tilted = Rigid::fromXyzYawPitchRoll(0, 0, 0, 0, 0, 90 * kDegree);  // the axis along -y
  const GaussianCell lying = cellOf(movedBy(tilted, view));
  EXPECT_NEAR(lying.covariance(1, 1), varianceOfGap(kSpacing * 10.5), 2e-4);
}

TEST(View, theRingsOfALidarAreThoseOfItsPoints)
{
  const Rigid cloud_T_lidar = Rigid::fromXyzYawPitchRoll(1, 2, 3, 0.3, 0.4, 0.5);
  PointCloud cloud;
  for (int column = 0; column < 360; ++column)
    for (int ring = 0; ring < 16; ++ring)
    {
      const Eigen::Vector3d p =
          cloud_T_lidar * Eigen::Vector3d((5 + ring) * rayAt(column * kDegree, (15 - 2 * ring) * kDegree));
      cloud.resize(cloud.size() + 1);
      cloud.x.back() = static_cast<float>(p.x());
      cloud.y.back() = static_cast<float>(p.y());
      cloud.z.back() = static_cast<float>(p.z());
      cloud.ring.back() = static_cast<std::uint8_t>(ring);
    }
  const std::vector<View> views = viewsOf(cloud, {cloud_T_lidar});
  ASSERT_TRUE(views[0].rings);
  EXPECT_NEAR(views[0].rings->spacing, kSpacing, 1e-5);
  EXPECT_LT((views[0].rings->axis - cloud_T_lidar.rotation * Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_FALSE(views[1].rings);
}
}  // namespace scanloom::ring_spread_unittest
