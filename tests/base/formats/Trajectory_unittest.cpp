#include "base/formats/Trajectory.h"

#include "base/formats/SecondsText.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"

#include <gmock/gmock.h>

namespace scanloom::trajectory_unittest
{
namespace
{
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::int64_t kEpoch = 1'750'000'000'000'000'000;

StampedPose poseAtX(std::int64_t ns, double x, double yaw = 0)
{
  return {fromNanoseconds(ns), Rigid::fromXyzYawPitchRoll(x, 0, 0, yaw, 0, 0)};
}

TEST(SecondsText, keepsEveryNanosecondThatADoubleWouldLose)
{
  EXPECT_EQ(secondsText(fromNanoseconds(kEpoch + 1)), "1750000000.000000001");
  EXPECT_EQ(parseSeconds("1750000000.000000001"), fromNanoseconds(kEpoch + 1));
  EXPECT_EQ(secondsText(fromNanoseconds(-5)), "-0.000000005");
  EXPECT_EQ(parseSeconds("-0.000000005"), fromNanoseconds(-5));
}

TEST(SecondsText, readsWhatOtherProgramsWrite)
{
  EXPECT_EQ(parseSeconds("12"), fromNanoseconds(12'000'000'000));
  EXPECT_EQ(parseSeconds("12.5"), fromNanoseconds(12'500'000'000));
  EXPECT_EQ(parseSeconds("1.0000000019"), fromNanoseconds(1'000'000'001));
  EXPECT_EQ(parseSeconds("1.750000000000000000e+09"), fromNanoseconds(kEpoch));
}

TEST(SecondsText, refusesWhatIsNoNumber)
{
  for (const char* text : {"", "-", ".", "1.2.3", "--1", "1,5", "abc", "1e", "99999999999", "1e300", "nan"})
    EXPECT_EQ(parseSeconds(text), std::nullopt) << text;
}

TEST(Trajectory, isWrittenAsTumWithNineDecimals)
{
  const TemporaryFolder folder;
  writeTum(folder / "t.tum", {poseAtX(kEpoch + 30, 1.25)});

  EXPECT_EQ(
      contentOf(folder / "t.tum"),
      "1750000000.000000030 1.250000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 1.000000000\n");
}

TEST(Trajectory, survivesTum)
{
  const TemporaryFolder folder;
  const Trajectory written{poseAtX(kEpoch, 1, 3.1), poseAtX(kEpoch + 7, -2, -3.1)};
  writeTum(folder / "t.tum", written);

  const Trajectory read = readTum(folder / "t.tum");

  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1].stamp, written[1].stamp);
  EXPECT_LT(boxMinus(read[1].map_T_body, written[1].map_T_body).norm(), 1e-8);
}

TEST(Trajectory, readsTheGroundTruthOfAStranger)
{
  SCANLOOM_NEEDS_DATA(path, "recordings/sparse/groundtruth.tum");

  const Trajectory truth = readTum(path);

  EXPECT_EQ(truth.size(), 3001U);
  EXPECT_EQ(truth.back().stamp - truth.front().stamp, 30s);
}

TEST(Trajectory, namesFileAndLineOfWhatItCannotRead)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "t.tum") << "# comment\n1.0 0 0 0 0 0 0 1\n2.0 0 0 0 0 0 1\n";

  EXPECT_THAT([&] { readTum(folder / "t.tum"); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("t.tum:3"), HasSubstr("qx qy qz qw"))));
}

TEST(Trajectory, refusesStampsThatGoBack)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "t.tum") << "2.0 0 0 0 0 0 0 1\n1.0 0 0 0 0 0 0 1\n";

  EXPECT_THAT([&] { readTum(folder / "t.tum"); }, ThrowsMessage<std::invalid_argument>(HasSubstr("t.tum:2")));
}

TEST(Trajectory, isWrittenAsKittiRows)
{
  const TemporaryFolder folder;
  writeKitti(folder / "poses.txt", folder / "times.txt", {poseAtX(1'500'000'000, 2)});

  EXPECT_EQ(contentOf(folder / "poses.txt"),
            "1.000000000 0.000000000 0.000000000 2.000000000 0.000000000 1.000000000 0.000000000 0.000000000 "
            "0.000000000 0.000000000 1.000000000 0.000000000\n");
  EXPECT_EQ(contentOf(folder / "times.txt"), "1.500000000\n");
}

TEST(Trajectory, isWrittenAsEurocWithWFirst)
{
  const TemporaryFolder folder;
  writeEuroc(folder / "t.csv", {poseAtX(kEpoch, 2)});

  EXPECT_THAT(contentOf(folder / "t.csv"),
              HasSubstr("\n1750000000000000000,2.000000000,0.000000000,0.000000000,1.000000000,0.000000000,"));
}
}  // namespace
}  // namespace scanloom::trajectory_unittest
