/** What MRPT's rawlog-edit makes of our rawlogs, operation by operation. */
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/smallRawlog.h"
#include "stockTool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>

#include <algorithm>
#include <sstream>

namespace scanloom::rawlog_edit_operations_unittest
{
namespace
{
using testing::HasSubstr;

struct StockOperations : testing::Test
{
  TemporaryFolder folder;
  std::filesystem::path in = writeSmallRawlog(folder / "in.rawlog");

  /** In the folder: external files and exports are named without it. */
  std::string stock(const std::string& arguments) const
  {
    return outputOf("cd " + folder.path().string() + " && rawlog-edit -p " SCANLOOM_PLUGIN " " + arguments);
  }
};

/** Stock tools may write another version of the header's class. */
std::string behindHeader(const std::filesystem::path& rawlog)
{
  const std::string bytes = uncompressed(rawlog);
  return bytes.substr(bytes.find("mrpt::obs::CObservationIMU"));
}

int linesOf(const std::string& text) { return static_cast<int>(std::count(text.begin(), text.end(), '\n')); }

TEST_F(StockOperations, describesHeaderCloudsAndFields)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-edit");
  const std::string text = stock("--describe -i in.rawlog");
  EXPECT_THAT(text, HasSubstr("\"scanloom\""));
  EXPECT_THAT(text, HasSubstr("mrpt::obs::CObservationPointCloud"));
  EXPECT_THAT(text, HasSubstr("CGenericPointsMap"));
  EXPECT_THAT(text, HasSubstr("mrpt::obs::CObservationIMU"));
}

TEST_F(StockOperations, movesASensorAndNothingElse)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-edit");
  std::ofstream(folder / "poses.ini") << "[a]\nsensorLabel = imu\npose_x = 1\npose_y = 2\npose_z = 3\npose_yaw = 90\n"
                                         "pose_pitch = 0\npose_roll = 0\n";
  stock("--sensors-pose poses.ini -i in.rawlog -o out.rawlog");

  const Observations before = observationsIn(in), after = observationsIn(folder / "out.rawlog");
  ASSERT_EQ(after.size(), before.size());
  for (const ObservationPtr& observation : observationsIn(folder / "out.rawlog", "imu"))
  {
    mrpt::poses::CPose3D pose;
    observation->getSensorPose(pose);
    EXPECT_NEAR(pose.y(), 2, 1e-9);
    EXPECT_NEAR(pose.yaw(), M_PI / 2, 1e-9);
  }
  const Observations clouds = observationsIn(folder / "out.rawlog", "lidar");
  ASSERT_EQ(clouds.size(), 4u);
  EXPECT_EQ(genericCloudOf(*cloudIn(clouds[0])).size(), 120u);
}

TEST_F(StockOperations, externalizesAndTakesBackTheSameBytes)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-edit");
  stock("--externalize -i in.rawlog -o out.rawlog");
  std::size_t files = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder / "out_Images"))
    files += file.path().extension() == ".bin";
  EXPECT_EQ(files, 4u);

  stock("--de-externalize -i out.rawlog -o back.rawlog");
  EXPECT_TRUE(behindHeader(folder / "back.rawlog") == behindHeader(in)) << "with all fields";
}

TEST_F(StockOperations, exportsImuSamplesAsText)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-edit");
  stock("--export-imu-txt -i in.rawlog");
  const std::string text = contentOf(folder / "in_imu.txt");
  EXPECT_EQ(linesOf(text), 1 + 8) << "a head line, two samples a scan";
  EXPECT_EQ(linesOf(contentOf(folder / "in_imu_right.txt")), 1 + 4);

  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  double stamp = 0, x = 0, y = 0, z = 0, wz = 0, wy = 0, wx = 0;
  lines >> stamp >> x >> y >> z >> wz >> wy >> wx;
  EXPECT_NEAR(stamp, 1'700'000'000.01, 1e-5);
  EXPECT_EQ((std::vector{x, y, z, wx, wy, wz}), (std::vector<double>{4, 5, 6, 1, 2, 3}));
}
}  // namespace
}  // namespace scanloom::rawlog_edit_operations_unittest
