#include "lab/study/RunReference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "support/TemporaryFolder.h"
#include "support/messageOf.h"

namespace scanloom::run_reference_unittest
{
namespace
{
using testing::HasSubstr;

constexpr const char* kStation = "t,x,y,z\n1,0,0,0\n2,1,0,0\n";
constexpr const char* kPoses = "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n3 2 0 0 0 0 0 1\n";

class RunReferenceOf : public testing::Test
{
 protected:
  RunReferenceOf() { write("recording.pcap", "packets"); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  TemporaryFolder folder_;
};

TEST_F(RunReferenceOf, isNoneWhereNothingLiesBesideTheRecording)
{
  write("imu.csv", "1,2,3,4,5,6,7\n");

  const RunReference reference = referenceOf(folder_.path(), "");

  EXPECT_FALSE(reference.exists());
  EXPECT_EQ(reference.description, "");
}

TEST_F(RunReferenceOf, isStationAndPosesBesideAFolderOrAFile)
{
  write("total_station.csv", kStation);
  write("groundtruth.tum", kPoses);
  write("extrinsics.txt", "T_body_prism 1 2 3 0 0 0\n");

  for (const auto& recording : {folder_.path(), folder_ / "recording.pcap"})
  {
    const RunReference reference = referenceOf(recording, "");
    ASSERT_TRUE(reference.station && reference.poses) << recording;
    EXPECT_EQ(reference.station->size(), 2U);
    EXPECT_EQ(reference.poses->size(), 3U);
    EXPECT_EQ(reference.body_p_point, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(reference.description, "total_station.csv at the prism, groundtruth.tum");
  }
}

TEST_F(RunReferenceOf, saysThatTheBodysOriginIsComparedWithoutAPrism)
{
  write("total_station.csv", kStation);

  const RunReference reference = referenceOf(folder_.path(), "");

  EXPECT_EQ(reference.body_p_point, Eigen::Vector3d::Zero());
  EXPECT_THAT(reference.description, HasSubstr("at the body's origin"));
}

TEST_F(RunReferenceOf, isTheGivenFileAlone)
{
  write("total_station.csv", kStation);
  write("survey.tum", kPoses);

  const RunReference given = referenceOf(folder_.path(), folder_ / "survey.tum");

  EXPECT_FALSE(given.station);
  EXPECT_EQ(given.poses->size(), 3U);
  EXPECT_FALSE(referenceOf(folder_.path(), kNoReference).exists());
}

TEST_F(RunReferenceOf, leavesNothingToChanceBetweenTwoFiles)
{
  write("groundtruth.tum", kPoses);
  write("groundtruth.txt", kPoses);

  EXPECT_THAT(messageOf<std::invalid_argument>([&] { referenceOf(folder_.path(), ""); }),
              testing::AllOf(HasSubstr("groundtruth.tum"), HasSubstr("name one in [experiment] references")));
}
}  // namespace
}  // namespace scanloom::run_reference_unittest
