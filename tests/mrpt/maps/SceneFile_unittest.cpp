#include "mrpt/maps/SceneFile.h"

#include <gtest/gtest.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/CPointCloudColoured.h>

#include <algorithm>
#include <limits>

namespace scanloom::scene_file_unittest
{
namespace
{
/** The larger of both numbers of lines. */
float linesOf(const mrpt::opengl::COpenGLScene& scene)
{
  const auto grid = scene.getByClass<mrpt::opengl::CGridPlaneXY>();
  float x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  grid->getPlaneLimits(x0, x1, y0, y1);
  return std::max(x1 - x0, y1 - y0) / grid->getGridFrequency();
}

Trajectory fromOriginTo(double x, double y) { return {{{}, {}}, {{}, Rigid::fromXyzYawPitchRoll(x, y, 0, 0, 0, 0)}}; }

TEST(SceneBuilder, drawsAGridOfTenMetresBelow)
{
  SceneBuilder scene;
  scene.addPath(fromOriginTo(95, 40));
  EXPECT_EQ(linesOf(*scene.finished()), 10);
}

TEST(SceneBuilder, drawsFewLinesHoweverFarThingsAre)
{
  for (const double far : {1e5, 1e20, 1e300})
  {
    SceneBuilder path;
    path.addPath(fromOriginTo(far, -far));
    SceneBuilder points;
    points.addPoints(std::vector<Eigen::Vector3f>(60, {static_cast<float>(std::min(far, 1e38)), 0, 0}));
    points.addPoints(std::vector<Eigen::Vector3f>(60, {-1e38F, 0, 0}));
    for (const SceneBuilder* scene : {&path, &points})
    {
      EXPECT_LE(linesOf(*scene->finished()), 1001) << far;
      EXPECT_GE(linesOf(*scene->finished()), 10) << far;
    }
  }
}

TEST(SceneBuilder, leavesOutPointsThatAreNotFinite)
{
  std::vector<Eigen::Vector3f> points(1000, {1, 2, 3});
  for (std::size_t i = 0; i < points.size(); i += 2)
    points[i][static_cast<Eigen::Index>(i % 3)] = std::numeric_limits<float>::quiet_NaN();
  SceneBuilder scene;
  scene.addPoints(points);
  EXPECT_EQ(scene.finished()->getByClass<mrpt::opengl::CPointCloudColoured>()->size(), 500u);
}
}  // namespace
}  // namespace scanloom::scene_file_unittest
