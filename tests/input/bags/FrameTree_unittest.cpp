#include "input/bags/internal/FrameTree.h"

#include <gmock/gmock.h>

namespace scanloom::frame_tree_unittest
{
namespace
{
FrameTransform moved(const char* parent, const char* child, double x)
{
  Rigid pose;
  pose.translation.x() = x;
  return {parent, child, pose};
}

TEST(FrameTree, connectsFramesThroughTheirCommonParent)
{
  FrameTree tree;
  tree.add(moved("base_link", "mast", 1));
  tree.add(moved("mast", "left", 2));
  tree.add(moved("base_link", "imu", 5));
  EXPECT_DOUBLE_EQ(tree.transform("base_link", "left")->translation.x(), 3);
  EXPECT_DOUBLE_EQ(tree.transform("imu", "left")->translation.x(), -2);
  EXPECT_EQ(tree.rootOf("left"), "base_link");
  EXPECT_FALSE(tree.transform("base_link", "elsewhere"));
}

TEST(FrameTree, endsWhereFramesGoInCircles)
{
  FrameTree tree;
  tree.add(moved("a", "b", 1));
  tree.add(moved("b", "a", 1));
  EXPECT_FALSE(tree.transform("a", "c"));
  EXPECT_FALSE(tree.transform("a", "b")) << "which of both?";
  EXPECT_EQ(tree.inCircles(), (std::vector<std::string>{"a", "b"}));
}

TEST(FrameTree, leavesOutWhatIsNoTransformAsTf2Does)
{
  FrameTree tree;
  tree.add(moved("base_link", "left", 1));
  tree.add(moved("left", "left", 2));
  tree.add(moved("", "left", 3));
  EXPECT_DOUBLE_EQ(tree.transform("base_link", "left")->translation.x(), 1);
  EXPECT_TRUE(tree.inCircles().empty());
}
}  // namespace
}  // namespace scanloom::frame_tree_unittest
