#include "input/rig/Extrinsics.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/messageOf.h"

namespace scanloom::extrinsics_unittest
{
namespace
{
std::map<std::string, Rigid> posesOf(const std::string& text)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "extrinsics.txt") << text;
  return readExtrinsics(folder / "extrinsics.txt");
}

std::string complaintAbout(const std::string& text)
{
  return messageOf<std::runtime_error>([&] { posesOf(text); });
}
}  // namespace

TEST(Extrinsics, readsPosesInMetresAndDegrees)
{
  const auto poses = posesOf("# a rig\nT_body_left 1 2 3 90 0 0\n");
  EXPECT_LT((poses.at("T_body_left") * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(1, 3, 3)).norm(), 1e-14);
}

TEST(Extrinsics, thePosesOfARecordingAgreeWithTheirMatrices)
{
  SCANLOOM_NEEDS_DATA(path, "recordings/sparse/extrinsics.txt");
  EXPECT_EQ(readExtrinsics(path).size(), 5u);
}

TEST(Extrinsics, aMatrixThatContradictsItsPoseIsAnError)
{
  EXPECT_NE(complaintAbout("T_body_left 1 2 3 0 0 0\n1 0 0 1\n0 1 0 2\n0 0 1 3.5\n0 0 0 1\n")
                .find(":4: the matrix contradicts"),
            std::string::npos);
}

TEST(Extrinsics, saysWhereAPoseIsWrong)
{
  EXPECT_NE(complaintAbout("\nT_body_left 1 2 3\n").find(":2: 3 numbers"), std::string::npos);
  EXPECT_NE(complaintAbout("T_a_b 1 2 3 0 0 x\n").find("'x' is not a number"), std::string::npos);
  EXPECT_NE(complaintAbout("T_a_b 1 2 3 0 0 0\nT_a_b 1 2 3 0 0 0\n").find(":2: T_a_b is given twice"),
            std::string::npos);
}

TEST(Extrinsics, aPoseReadsLikeMrpts)
{
  EXPECT_LT((parsePose("[1.5 1.2 2.5 30 15 -25]").yawPitchRoll() * 180 / M_PI - Eigen::Vector3d(30, 15, -25)).norm(),
            1e-12);
  EXPECT_THROW(parsePose("[1 2 3]"), std::invalid_argument);
  EXPECT_THROW(parsePose("[1 2 3 4 5 6deg]"), std::invalid_argument);
}
}  // namespace scanloom::extrinsics_unittest
