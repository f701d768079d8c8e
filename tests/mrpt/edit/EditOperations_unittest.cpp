/** From the values of the command line to operations. */
#include "mrpt/edit/EditOperations.h"

#include "base/core/ConfigError.h"
#include "mrpt/edit/CloudObservation.h"
#include "smallRawlog.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace scanloom::edit_operations_unittest
{
namespace
{
using testing::HasSubstr;

struct EditOperations : testing::Test
{
  TemporaryFolder folder;
  const std::filesystem::path in = writeSmallRawlog(folder / "in.rawlog");
  const std::filesystem::path out = folder / "out.rawlog";
  EditOptions options;
  std::string notices;

  std::vector<EditOperation> operations()
  {
    return editOperations(options, in, [this](const std::string& line) { notices += line + '\n'; });
  }
  void edit() { edited(in, chained(operations(), in, operations().back().outputs), out); }
  std::string complaint()
  {
    return messageOf<UsageError>([&] { operations(); });
  }
};

struct WrongValue
{
  const char* complaint;
  void (*set)(EditOptions&);
};
const std::vector<WrongValue> kWrongValues{
    {"--crop-box", [](EditOptions& o) { o.crop_box = "0 0 0 1 1"; }},
    {"--crop-box", [](EditOptions& o) { o.crop_box = "0 0 0 1 1 -1"; }},
    {"--time-offset", [](EditOptions& o) { o.time_offset = "imu"; }},
    {"--time-offset", [](EditOptions& o) { o.time_offset = "imu=soon"; }},
    {"--from-time", [](EditOptions& o) { o.from_time = "yesterday"; }},
    {"the cut is empty", [](EditOptions& o) { o.from_index = 5, o.to_index = 4; }},
    {"--ranges", [](EditOptions& o) { o.ranges = "5 4"; }},
    {"--export", [](EditOptions& o) { o.export_as = "las=clouds"; }},
    {"--convert-clouds", [](EditOptions& o) { o.convert_clouds = "CMap"; }},
};

TEST_F(EditOperations, wrongValuesAreNamed)
{
  for (const WrongValue& wrong : kWrongValues)
  {
    options = {};
    wrong.set(options);
    EXPECT_THAT(complaint(), HasSubstr(wrong.complaint));
  }
}

TEST_F(EditOperations, theCutComesFirst)
{
  options.from_time = "1700000000.1";
  options.to_time = "1700000000.3";
  options.split_lidars = true;
  edit();
  EXPECT_EQ(observationsIn(out, "lidar_left").size(), 3u);
}

TEST_F(EditOperations, deskewingByAnImuTellsWhatIsKnownOfItsBias)
{
  options.deskew = "imu";  // 60 deg/s and more throughout: never at rest
  edit();
  EXPECT_THAT(notices, HasSubstr("warning: 'imu' is never at rest"));
  EXPECT_EQ(observationsIn(out, "lidar").size(), 4u);

  options.deskew = "imu=imu_left";
  EXPECT_THROW(edit(), UsageError) << "the rawlog has none";
}

/** The same two poses, 5 ms before the first scan and 245 ms after its start, at 10 m/s along x. */
TEST_F(EditOperations, trajectoriesOfAllThreeFormatsDeskewAndMap)
{
  std::ofstream(folder / "t.tum") << "1699999999.995 0 0 0 0 0 0 1\n1700000000.245 2.5 0 0 0 0 0 1\n";
  std::ofstream(folder / "t.csv") << "#timestamp,x,y,z,qw,qx,qy,qz\n1699999999995000000,0,0,0,1,0,0,0\n"
                                     "1700000000245000000,2.5,0,0,1,0,0,0\n";
  std::ofstream(folder / "t.txt") << "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 2.5 0 1 0 0 0 0 1 0\n";
  std::ofstream(folder / "times.txt") << "1699999999.995\n1700000000.245\n";
  for (const std::string name : {"t.tum", "t.csv", "t.txt"})
  {
    options = {};
    options.deskew = (folder / name).string();
    edit();
    const Observations clouds = observationsIn(out, "lidar");
    ASSERT_EQ(clouds.size(), 2u) << name;
    EXPECT_NEAR(positionsInBody(*cloudIn(clouds[0]))[4].x(), 0.4f + 10 * 2.441403e-3f, 1e-5) << name;
  }
}

TEST_F(EditOperations, aTrajectoryWithoutPosesIsAnError)
{
  std::ofstream(folder / "empty.tum") << "# stamp x y z qx qy qz qw\n";
  options.deskew = (folder / "empty.tum").string();
  EXPECT_THROW(edit(), std::exception);
  EXPECT_FALSE(std::filesystem::exists(out));
}
}  // namespace
}  // namespace scanloom::edit_operations_unittest
