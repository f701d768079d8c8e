#include "mrpt/maps/MapPicture.h"

#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>

#include <cmath>

namespace scanloom::map_picture_unittest
{
namespace
{
constexpr double kStemX = 5.0, kStemY = 3.0;

/** A flat floor of 30 m with one stem of 2 m height. */
Keyframe floorWithStem()
{
  Keyframe keyframe;
  const auto add = [&](double x, double y, double z)
  {
    PointCloud& cloud = keyframe.points;
    cloud.resize(cloud.size() + 1);
    cloud.x.back() = static_cast<float>(x);
    cloud.y.back() = static_cast<float>(y);
    cloud.z.back() = static_cast<float>(z);
  };
  for (double x = -15; x < 15; x += 0.2)
    for (double y = -15; y < 15; y += 0.2) add(x, y, 0.01);
  for (double z = 0; z < 2; z += 0.05)
    for (int degree = 0; degree < 360; degree += 5)
      add(kStemX + 0.3 * std::cos(degree * M_PI / 180), kStemY + 0.3 * std::sin(degree * M_PI / 180), z);
  return keyframe;
}

using PictureOfVoxels = testing::TestWithParam<std::size_t>;
INSTANTIATE_TEST_SUITE_P(All, PictureOfVoxels, testing::Values(1'000'000));
INSTANTIATE_TEST_SUITE_P(FourTimesAsWide, PictureOfVoxels, testing::Values(9'000));

TEST_P(PictureOfVoxels, showsTheStemWhereItStands)
{
  const TemporaryFolder folder;
  MapPicture picture({10.0, 1000, GetParam()});
  picture.add(floorWithStem());
  const Trajectory path{{Timestamp{}, Rigid::identity()}, {Timestamp{1s}, Rigid{{1, 0, 0, 0}, {0, -4, 0}}}};
  picture.write(folder / "map.png", {path}, "a test");

  mrpt::img::CImage image;
  ASSERT_TRUE(image.loadFromFile((folder / "map.png").string()));
  // 24 m, from y = 10 down to -14, fill the 900 pixels within the borders of 50; 860 pixels is the least width.
  const double scale = 900.0 / 24.0;
  const int left = (860 - static_cast<int>(std::ceil(20 * scale))) / 2;
  const auto brightness = [&](double x, double y)
  {
    const auto* pixel = image.ptr<std::uint8_t>(static_cast<unsigned>(left + scale * (x + 10)),
                                                static_cast<unsigned>(40 + scale * (10 - y)));
    return (pixel[0] + pixel[1] + pixel[2]) / 3;
  };
  EXPECT_LT(brightness(kStemX + 0.3, kStemY + 0.02), 110) << "the stem's bark at breast height";
  EXPECT_GT(brightness(kStemX - 3.3, kStemY + 1.3), 180) << "bare ground";
}

TEST_P(PictureOfVoxels, isTheSameForKeyframesInAnyOrder)
{
  const TemporaryFolder folder;
  const Trajectory path{{Timestamp{}, Rigid::identity()}};
  Keyframe other = floorWithStem();
  other.map_T_body.translation = {7, 0, 0.3};
  for (const bool other_first : {true, false})
  {
    MapPicture picture({10.0, 600, GetParam()});
    picture.add(other_first ? other : floorWithStem());
    picture.add(other_first ? floorWithStem() : other);
    picture.write(folder / (other_first ? "a.png" : "b.png"), {path}, "a test");
  }
  EXPECT_EQ(contentOf(folder / "a.png"), contentOf(folder / "b.png"));
}

TEST(MapPicture, needsATrajectory)
{
  const TemporaryFolder folder;
  EXPECT_THROW(MapPicture({}).write(folder / "map.png", {}, ""), std::invalid_argument);
}
}  // namespace
}  // namespace scanloom::map_picture_unittest
