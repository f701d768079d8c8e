/** Operations on points by their place. */
#include "mrpt/edit/internal/CropClouds.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/internal/ThinClouds.h"
#include "smallRawlog.h"
#include "support/with.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>

namespace scanloom::crop_clouds_unittest
{
namespace
{
using testing::ElementsAre;

/** Points on the x axis at 1, 2, ... m; odd ones of lidar 1, even ones of lidar 0. */
mrpt::obs::CObservationPointCloud::Ptr fivePoints()
{
  Scan scan;
  scan.start = kSmallStart;
  scan.points.resize(5);
  for (std::size_t i = 0; i < 5; ++i)
  {
    scan.points.x[i] = static_cast<float>(i + 1);
    scan.points.sensor_id[i] = (i + 1) % 2;
    scan.points.ring[i] = static_cast<std::uint8_t>(10 + i);
  }
  return toObservation(scan);
}

RecordingHeader lidarsAt(double x0, double x1)
{
  RecordingHeader header = someHeader();
  header.lidars[0].body_T_sensor = Rigid::fromXyzYawPitchRoll(x0, 0, 0, 1, 0, 0);
  header.lidars[1].body_T_sensor = Rigid::fromXyzYawPitchRoll(x1, 0, 0, 0, 1, 0);
  return header;
}

std::vector<float> xOf(const Observations& observations)
{
  std::vector<float> xs;
  for (const Eigen::Vector3f& p : positionsInBody(*cloudIn(observations.at(0)))) xs.push_back(p.x());
  return xs;
}

TEST(CropClouds, removesWhatIsInTheBoxWithItsEdges)
{
  const Eigen::AlignedBox3f box(Eigen::Vector3f(2, -1, -1), Eigen::Vector3f(3.5f, 1, 1));
  const Observations result = cropOut(box)(fivePoints());
  EXPECT_THAT(xOf(result), ElementsAre(1, 4, 5));
  EXPECT_THAT(*genericCloudOf(*cloudIn(result[0])).getPointsBufferRef_uint16_field("ring"), ElementsAre(10, 13, 14));
}

TEST(CropClouds, theBoxIsInTheBodyFrameWhateverTheCloudsFrame)
{
  const auto cloud = fivePoints();
  cloud->sensorPose = toMrpt(Rigid::fromXyzYawPitchRoll(10, 0, 0, M_PI, 0, 0));  // points at 9, 8, ... m
  const Eigen::AlignedBox3f box(Eigen::Vector3f(7.5f, -1, -1), Eigen::Vector3f(20, 1, 1));
  const Observations result = cropOut(box)(cloud);
  EXPECT_THAT(xOf(result),
              ElementsAre(testing::FloatNear(7, 1e-5f), testing::FloatNear(6, 1e-5f), testing::FloatNear(5, 1e-5f)));
}

TEST(CropClouds, cloudsOfOtherClassesStayWhatTheyAre)
{
  const auto cloud = fivePoints();
  auto simple = mrpt::maps::CSimplePointsMap::Create();
  for (int i = 1; i <= 3; ++i) simple->insertPoint(static_cast<float>(i), 0, 0);
  cloud->pointcloud = simple;
  const Observations result = cropOut({Eigen::Vector3f(1.5f, -1, -1), Eigen::Vector3f(2.5f, 1, 1)})(cloud);
  EXPECT_THAT(xOf(result), ElementsAre(1, 3));
  EXPECT_TRUE(std::dynamic_pointer_cast<mrpt::maps::CSimplePointsMap>(cloudIn(result[0])->pointcloud));
}

TEST(CropClouds, rangesCountFromTheLidarThatMeasured)
{
  // Lidar 0 at 0 m measured 2 and 4 m; lidar 1 at 5 m measured 1, 3 and 5 m from 4, 2 and 0 m away.
  EXPECT_THAT(
      xOf(limitRanges(with(&RangeLimits::least, 1.5, with(&RangeLimits::most, 4)), lidarsAt(0, 5))(fivePoints())),
      ElementsAre(1, 2, 3, 4));
}

TEST(CropClouds, withoutAHeaderRangesCountFromTheCloudsOwnFrame)
{
  const auto cloud = fivePoints();
  cloud->sensorPose = toMrpt(Rigid::fromXyzYawPitchRoll(100, 0, 0, 0, 0, 0));
  EXPECT_THAT(xOf(limitRanges(with(&RangeLimits::most, 2), std::nullopt)(cloud)), ElementsAre(101, 102));
}

TEST(ThinClouds, keepsTheFirstPointOfEachCube)
{
  // Cubes of 2 m: 1 | 2, 3 | 4, 5.
  EXPECT_THAT(xOf(thinClouds(2)(fivePoints())), ElementsAre(1, 2, 4));
}
}  // namespace
}  // namespace scanloom::crop_clouds_unittest
