#include "base/formats/TrajectoryReader.h"

#include "support/TemporaryFolder.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>

namespace scanloom::trajectory_reader_unittest
{
namespace
{
struct ForeignTrajectories : testing::Test
{
  TemporaryFolder folder;
  std::filesystem::path write(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
};

/** A quarter turn to the left about z, at (1, 2, 3). */
void expectQuarterTurn(const Rigid& pose)
{
  EXPECT_LT((pose * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(1, 3, 3)).norm(), 1e-6);
}

TEST_F(ForeignTrajectories, eurocHasNanosecondsAndWFirst)
{
  const auto path = write("data.csv",
                          "#timestamp,p_x,p_y,p_z,q_w,q_x,q_y,q_z,v_x\r\n"
                          "1403636579763555584,1,2,3,0.70710678,0,0,0.70710678,0.5\r\n"
                          "1403636579768555585,1,2,4,1,0,0,0,0.5\r\n");
  const Trajectory read = readTrajectory(path);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(nanoseconds(read[0].stamp), 1403636579763555584);
  EXPECT_EQ(nanoseconds(read[1].stamp), 1403636579768555585);
  expectQuarterTurn(read[0].map_T_body);
}

TEST_F(ForeignTrajectories, kittiHasRowsOfAMatrixAndStampsBeside)
{
  write("times.txt", "0.000000e+00\n1.036224e-01\n");
  const auto path = write("00.txt", "0 -1 0 1 1 0 0 2 0 0 1 3\n1 0 0 4 0 1 0 5 0 0 1 6\n");
  const Trajectory read = readTrajectory(path);
  ASSERT_EQ(read.size(), 2U);
  expectQuarterTurn(read[0].map_T_body);
  EXPECT_EQ(nanoseconds(read[1].stamp), 103622400);
  EXPECT_EQ(read[1].map_T_body.translation, Eigen::Vector3d(4, 5, 6));
}

TEST_F(ForeignTrajectories, tumHasSecondsAndWLast)
{
  const auto path = write("gt.txt", "# ground truth\n1305031102.1758 1 2 3 0 0 0.70710678 0.70710678\n");
  const Trajectory read = readTrajectory(path);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(nanoseconds(read[0].stamp), 1305031102175800000);
  expectQuarterTurn(read[0].map_T_body);
}

TEST_F(ForeignTrajectories, ofOursAreReadBack)
{
  const Trajectory written{
      {fromNanoseconds(1'750'000'000'000'000'030), Rigid::fromXyzYawPitchRoll(1, 2, 3, 0.4, 0.1, 0)},
      {fromNanoseconds(1'750'000'000'100'000'031), Rigid::fromXyzYawPitchRoll(4, 5, 6, -2, 0, 0.3)}};
  writeEuroc(folder / "ours.csv", written);
  writeKitti(folder / "ours.txt", folder / "ours_times.txt", written);
  for (const char* name : {"ours.csv", "ours.txt"})
  {
    const Trajectory read = readTrajectory(folder / name);
    ASSERT_EQ(read.size(), 2U) << name;
    for (std::size_t i = 0; i < 2; ++i)
    {
      EXPECT_EQ(read[i].stamp, written[i].stamp) << name;
      EXPECT_LT(boxMinus(read[i].map_T_body, written[i].map_T_body).norm(), 1e-7) << name;
    }
  }
}

TEST_F(ForeignTrajectories, nameFileAndLineOfWhatIsWrong)
{
  const auto euroc = write("bad.csv", "1403636579763555584,1,2,3,1,0,0,0\n1403636579763555583,1,2,3,1,0,0,0\n");
  EXPECT_THAT(messageOf<std::invalid_argument>([&] { readTrajectory(euroc); }), testing::HasSubstr("bad.csv:2: stamp"));
  const auto kitti = write("01.txt", "1 0 0 4 0 1 0 5 0 0 1 6\n1 0 0 4 0 1 0 5 0 0 1 x\n");
  EXPECT_THAT(messageOf<std::invalid_argument>([&] { readTrajectory(kitti); }), testing::HasSubstr("have no stamps"));
  write("01_times.txt", "0\n1\n");
  EXPECT_THAT(messageOf<std::invalid_argument>([&] { readTrajectory(kitti); }),
              testing::HasSubstr("01.txt:2: expected twelve numbers"));
  write("01.txt", "1 0 0 4 0 1 0 5 0 0 1 6\n");
  EXPECT_THAT(messageOf<std::invalid_argument>([&] { readTrajectory(kitti); }),
              testing::HasSubstr("1 poses, but 2 stamps"));
}

TEST_F(ForeignTrajectories, withAStampTwiceKeepTheFirstPoseAndSaySo)
{
  std::vector<std::string> notes;
  const auto note = [&](const std::string& text) { notes.push_back(text); };
  const Trajectory read =
      readTrajectory(write("twice.tum", "10 1 2 3 0 0 0 1\n11 1 2 3 0 0 0 1\n11 4 5 6 0 0 0 1\n"), note);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1].map_T_body.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_THAT(notes, testing::ElementsAre(testing::HasSubstr("1 poses have the stamp of the one before")));
}

TEST_F(ForeignTrajectories, ofTumWithIntegersAreTakenInTheUnitInWhichTheyAreDates)
{
  for (const auto& [text, unit] :
       {std::pair("1750000000123456789", "ns"), std::pair("1750000000123456", "us"), std::pair("1750000000123", "ms")})
  {
    std::string notes;
    const Trajectory read = readTrajectory(write("a.tum", std::string(text) + " 1 2 3 0 0 0 1\n"),
                                           [&](const std::string& note) { notes += note; });
    ASSERT_EQ(read.size(), 1U);
    EXPECT_NEAR(seconds(read[0].stamp - fromNanoseconds(1'750'000'000'123'456'789)), 0, 1e-3);
    EXPECT_THAT(notes, testing::HasSubstr(std::string("taken as ") + unit));
  }
  EXPECT_EQ(readTrajectory(write("a.tum", "1750000000 1 2 3 0 0 0 1\n"))[0].stamp, Timestamp{1'750'000'000s});
}

/** Found by output_trajectory_fuzz: such poses could be read, but neither written as TUM nor interpolated. */
TEST_F(ForeignTrajectories, stampsWhoseDifferenceOverflowsAreRefused)
{
  const std::string pose = ",1,2,3,1,0,0,0\n";
  EXPECT_THROW(readTrajectory(write("late.csv", "9223372036854775807" + pose)), std::invalid_argument);
  EXPECT_THROW(readTrajectory(write("early.csv", "-9223372036854775807" + pose)), std::invalid_argument);
  EXPECT_THROW(readTrajectory(write("both.tum", "-8999999999 1 2 3 0 0 0 1\n8999999999 1 2 3 0 0 0 1\n")),
               std::invalid_argument);
  EXPECT_EQ(readTrajectory(write("2111.csv", "4449999999999999999" + pose)).size(), 1U);
}
}  // namespace
}  // namespace scanloom::trajectory_reader_unittest
