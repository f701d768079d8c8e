#include "mrpt/maps/OctoMapExport.h"

#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <octomap/octomap.h>

#include <cmath>

namespace scanloom::octo_map_export_unittest
{
namespace
{
enum class State
{
  Unknown,
  Free,
  Occupied,
};

std::ostream& operator<<(std::ostream& out, State state) { return out << static_cast<int>(state); }

State stateAt(const octomap::OcTree& tree, const Eigen::Vector3d& p)
{
  const octomap::OcTreeNode* node = tree.search(p.x(), p.y(), p.z());
  if (!node) return State::Unknown;
  return tree.isNodeOccupied(node) ? State::Occupied : State::Free;
}

const Rigid kBodyTLeft = Rigid::fromXyzYawPitchRoll(0, 1.25, 0.05, 0, 0, 0);
const Rigid kBodyTRight = Rigid::fromXyzYawPitchRoll(0, -1.25, 0.05, 0, 0, 0);

void addPoint(PointCloud& cloud, const Eigen::Vector3d& p, std::uint8_t sensor_id)
{
  cloud.resize(cloud.size() + 1);
  cloud.x.back() = static_cast<float>(p.x());
  cloud.y.back() = static_cast<float>(p.y());
  cloud.z.back() = static_cast<float>(p.z());
  cloud.sensor_id.back() = sensor_id;
}

Keyframe keyframeOf(const Eigen::Vector3d& p, std::uint8_t sensor_id)
{
  Keyframe keyframe;
  addPoint(keyframe.points, p, sensor_id);
  return keyframe;
}

/** The side of a vertical stem that faces the lidar at `origin`, sampled every degree and 2 cm of height. */
void addStemSeenFrom(PointCloud& cloud, const Eigen::Vector3d& origin, const Eigen::Vector3d& stem, double radius,
                     std::uint8_t sensor_id)
{
  for (int degree = 0; degree < 360; ++degree)
    for (double z = -1; z < 1; z += 0.02)
    {
      const Eigen::Vector3d normal(std::cos(degree * M_PI / 180), std::sin(degree * M_PI / 180), 0);
      const Eigen::Vector3d p = stem + radius * normal + Eigen::Vector3d(0, 0, z);
      if (normal.dot(origin - p) > 0) addPoint(cloud, p, sensor_id);
    }
}

TEST(OctoMapBuilder, freesTheLineFromEachLidarsOwnOrigin)
{
  OctoMapBuilder builder(octoMapPreset("inventory"), {kBodyTLeft, kBodyTRight});
  builder.add(keyframeOf({10.05, -1.25, 0.05}, 1));

  EXPECT_EQ(stateAt(builder.tree(), {10.05, -1.25, 0.05}), State::Occupied);
  EXPECT_EQ(stateAt(builder.tree(), {5.05, -1.25, 0.05}), State::Free);
  EXPECT_EQ(stateAt(builder.tree(), {5.05, 0.05, 0.05}), State::Unknown) << "the line from the other lidar or the body";
  EXPECT_EQ(stateAt(builder.tree(), {10.35, -1.25, 0.05}), State::Unknown) << "behind the point";
}

TEST(OctoMapBuilder, movesPointsAndOriginsByThePoseOfTheKeyframe)
{
  OctoMapBuilder builder(octoMapPreset("inventory"), {kBodyTLeft});
  Keyframe keyframe = keyframeOf({5.05, 1.25, 0.05}, 0);
  keyframe.map_T_body = Rigid::fromXyzYawPitchRoll(100, 0, 0, M_PI / 2, 0, 0);
  builder.add(keyframe);

  EXPECT_EQ(stateAt(builder.tree(), {98.75, 5.05, 0.05}), State::Occupied);
  EXPECT_EQ(stateAt(builder.tree(), {98.75, 2.05, 0.05}), State::Free);
}

TEST(OctoMapBuilder, onlyFreesTheLineUpToTheLargestRange)
{
  OctoMapBuilder builder({0.1, 5.0}, {Rigid::identity()});
  builder.add(keyframeOf({10, 0, 0}, 0));

  EXPECT_EQ(stateAt(builder.tree(), {4.5, 0, 0}), State::Free);
  EXPECT_EQ(stateAt(builder.tree(), {5.5, 0, 0}), State::Unknown);
  EXPECT_EQ(stateAt(builder.tree(), {10, 0, 0}), State::Unknown);
}

TEST(OctoMapBuilder, hasInItsAreaWhatItWouldHaveThereWithoutOne)
{
  const MapArea area{{3.2, -3.2}, 6.4};
  OctoMapBuilder whole(octoMapPreset("inventory"), {kBodyTLeft}), part(octoMapPreset("inventory"), {kBodyTLeft}, area);
  Keyframe keyframe;
  addStemSeenFrom(keyframe.points, kBodyTLeft.translation, {6, 0.3, 0}, 0.15, 0);
  addStemSeenFrom(keyframe.points, kBodyTLeft.translation, {16, 1, 0}, 0.15, 0);  // through the area and beyond
  addStemSeenFrom(keyframe.points, kBodyTLeft.translation, {-6, 1, 0}, 0.15, 0);
  for (OctoMapBuilder* builder : {&whole, &part}) builder->add(keyframe);

  std::size_t within = 0;
  for (auto leaf = whole.tree().begin_leafs(); leaf != whole.tree().end_leafs(); ++leaf)
  {
    const bool is_in = leaf.getX() > 3.2 && leaf.getX() < 9.6 && std::abs(leaf.getY()) < 3.2;
    const octomap::OcTreeNode* node = part.tree().search(leaf.getKey());
    ASSERT_EQ(node != nullptr, is_in) << leaf.getX() << " " << leaf.getY();
    if (!is_in) continue;
    EXPECT_EQ(node->getLogOdds(), leaf->getLogOdds());
    ++within;
  }
  EXPECT_GT(within, 1000U);
}

TEST(OctoMapBuilder, doesNotCarveAStemThatBothLidarsSee)
{
  const Eigen::Vector3d stem(6, 0.3, 0);
  Keyframe keyframe;
  addStemSeenFrom(keyframe.points, kBodyTLeft.translation, stem, 0.15, 0);
  addStemSeenFrom(keyframe.points, kBodyTRight.translation, stem, 0.15, 1);
  OctoMapBuilder builder(octoMapPreset("fine"), {kBodyTLeft, kBodyTRight});
  for (int again = 0; again < 5; ++again) builder.add(keyframe);

  std::size_t carved = 0;
  for (std::size_t i = 0; i < keyframe.points.size(); ++i)
    carved += stateAt(builder.tree(), keyframe.points.position(i).cast<double>()) != State::Occupied;
  EXPECT_EQ(carved, 0U) << "of " << keyframe.points.size();
}

TEST(OctoMapBuilder, writesBothFormatsThatOctomapReadsBack)
{
  const TemporaryFolder folder;
  OctoMapBuilder builder(octoMapPreset("preview"), {Rigid::identity()});
  builder.add(keyframeOf({7.1, 0.1, 0.1}, 0));
  const octomap::OcTree built(builder.tree());
  std::move(builder).write(folder / "map.bt", folder / "map.ot");

  octomap::OcTree binary((folder / "map.bt").string());
  const std::unique_ptr<octomap::AbstractOcTree> full(octomap::AbstractOcTree::read((folder / "map.ot").string()));

  EXPECT_DOUBLE_EQ(binary.getResolution(), 0.2);
  EXPECT_EQ(stateAt(binary, {7.1, 0.1, 0.1}), State::Occupied);
  EXPECT_EQ(stateAt(binary, {3.1, 0.1, 0.1}), State::Free);
  const auto* tree = dynamic_cast<octomap::OcTree*>(full.get());
  ASSERT_TRUE(tree);
  EXPECT_EQ(tree->search(7.1, 0.1, 0.1)->getLogOdds(), built.search(7.1, 0.1, 0.1)->getLogOdds());
  EXPECT_EQ(tree->search(3.1, 0.1, 0.1)->getLogOdds(), built.search(3.1, 0.1, 0.1)->getLogOdds());
}

TEST(OctoMapBuilder, isReadByTheStockConverter)
{
  if (std::system("command -v bt2vrml >/dev/null") != 0) GTEST_SKIP() << "octomap-tools is not installed";
  const TemporaryFolder folder;
  OctoMapBuilder builder(octoMapPreset("preview"), {Rigid::identity()});
  builder.add(keyframeOf({7.1, 0.1, 0.1}, 0));
  std::move(builder).write(folder / "map.bt", folder / "map.ot");

  ASSERT_EQ(std::system(("bt2vrml " + (folder / "map.bt").string() + " >/dev/null 2>&1").c_str()), 0);
  EXPECT_THAT(contentOf(folder / "map.bt.wrl"), testing::HasSubstr("7.1 0.1 0.1"));
}

TEST(OctoMapBuilder, refusesWhatHasNoPoseOrNoName)
{
  OctoMapBuilder builder(octoMapPreset("preview"), {Rigid::identity()});

  EXPECT_THROW(builder.add(keyframeOf({1, 0, 0}, 1)), std::invalid_argument);
  EXPECT_THROW(octoMapPreset("coarse"), std::invalid_argument);
}
}  // namespace
}  // namespace scanloom::octo_map_export_unittest
