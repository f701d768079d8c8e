#include "run/run/internal/DenseMap.h"

#include "base/core/ConfigError.h"
#include "base/formats/CloudFile.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>

namespace scanloom::dense_map_unittest
{
namespace
{
/** One point 2 m ahead of a body that is `x` m along the map's x axis. */
StateEstimate seenFrom(double x, Health health = Health::Ok)
{
  StateEstimate estimate;
  estimate.stamp = Timestamp{fromSeconds(100 + x)};
  estimate.map_T_body.translation.x() = x;
  estimate.health = health;
  estimate.cloud.resize(1);
  estimate.cloud.x[0] = 2;
  return estimate;
}

struct Written
{
  std::vector<double> places;  // x, m
  RunSummary summary;
};

Written denseMapOf(const std::vector<StateEstimate>& estimates, double voxel)
{
  const TemporaryFolder folder;
  Written written;
  DenseMap map(folder.path(), {false, "ply", voxel});
  for (const StateEstimate& estimate : estimates) map.add(estimate);
  map.close(written.summary);
  for (const Eigen::Vector3f& p : readCloud(folder / "dense_map.ply").points) written.places.push_back(p.x());
  return written;
}

TEST(DenseMap, hasThePointsOfEveryScanInTheMapFrame)
{
  const Written written = denseMapOf({seenFrom(0), seenFrom(0.01), seenFrom(5)}, 0);
  EXPECT_THAT(written.places, testing::ElementsAre(testing::DoubleNear(2, 1e-5), testing::DoubleNear(2.01, 1e-5),
                                                   testing::DoubleNear(7, 1e-5)));
  EXPECT_EQ(written.summary.counts.at("dense_map_points"), 3U);
}

TEST(DenseMap, hasTheFirstPointOfEachVoxel)
{
  EXPECT_THAT(denseMapOf({seenFrom(0.01), seenFrom(0.02), seenFrom(5)}, 0.1).places,
              testing::ElementsAre(testing::DoubleNear(2.01, 1e-5), testing::DoubleNear(7, 1e-5)));
}

TEST(DenseMap, leavesOutWhatALostMachineSaw)
{
  EXPECT_THAT(denseMapOf({seenFrom(0), seenFrom(5, Health::Lost)}, 0).places, testing::SizeIs(1));
}

TEST(DenseMap, refusesAnotherFormat) { EXPECT_THROW(DenseMap::nameOf({false, "xyz", 0}), ConfigError); }
}  // namespace
}  // namespace scanloom::dense_map_unittest
