#include "run/run/StaticClouds.h"

#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace scanloom::static_clouds_unittest
{
namespace
{
std::filesystem::path cloudIn(const TemporaryFolder& folder, const std::string& name)
{
  std::ofstream(folder / name) << "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                                  "property float z\nend_header\n1 2 3\n";
  return folder / name;
}

std::filesystem::path extrinsicsIn(const TemporaryFolder& folder, const std::string& text)
{
  std::ofstream(folder / "extrinsics.txt") << text;
  return folder / "extrinsics.txt";
}
}  // namespace

TEST(StaticClouds, areCalledLikeTheirFilesAndHaveThePosesOfTheExtrinsics)
{
  const TemporaryFolder folder;
  const StaticClouds clouds =
      readStaticClouds({cloudIn(folder, "left.ply")}, {extrinsicsIn(folder, "T_body_left 1 2 3 0 0 0\n")});
  ASSERT_EQ(clouds.lidars.size(), 1u);
  EXPECT_EQ(clouds.lidars[0].name, "left");
  EXPECT_EQ(clouds.points[0].body_T_sensor.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(clouds.points[0].points, std::vector<Eigen::Vector3f>({{1, 2, 3}}));
  EXPECT_EQ(clouds.poses, PoseGiven::Within20Degrees);
}

TEST(StaticClouds, withoutExtrinsicsHaveNoPoses)
{
  const TemporaryFolder folder;
  EXPECT_EQ(readStaticClouds({cloudIn(folder, "left.ply")}, {}).poses, PoseGiven::No);
}

TEST(StaticClouds, ofWhichOneHasNoPoseAreRefused)
{
  const TemporaryFolder folder;
  EXPECT_THROW(readStaticClouds({cloudIn(folder, "left.ply")}, {extrinsicsIn(folder, "T_body_right 1 2 3 0 0 0\n")}),
               std::runtime_error);
}
}  // namespace scanloom::static_clouds_unittest
