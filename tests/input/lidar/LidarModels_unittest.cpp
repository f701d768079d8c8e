#include "input/lidar/LidarModels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "captures.h"
#include "simpleMetadata.h"
#include "support/TemporaryFolder.h"

namespace scanloom::lidar_models_unittest
{
TEST(LidarModels, everyMetadataFileOfOusterMakesADecoderWithTheExtrinsicsFoldedIn)
{
  SCANLOOM_NEEDS_DATA(file, kOusterCaptures + "OS-0-128_v3.0.1_1024x10.json");
  const auto decoder = makeDecoder(file.string(), Rigid::fromXyzYawPitchRoll(1, 2, 3, 0, 0, 0));
  const LidarDescription& d = decoder->description();
  EXPECT_EQ(d.model, "OS-0-128");
  EXPECT_EQ(d.serial, "122322000614");
  EXPECT_EQ(d.channels, 128);
  EXPECT_EQ(d.columns_per_frame, 1024);
  EXPECT_EQ(d.columns_per_packet, 16);
  EXPECT_EQ(d.returns, 2);
  EXPECT_EQ(d.frame_rate, 10);
  EXPECT_EQ(d.frame_id_modulus, 65536u);
  EXPECT_EQ(d.blockPeriod(), Duration(97656));
  EXPECT_EQ(d.clock, "TIME_FROM_INTERNAL_OSC");
  EXPECT_LT((d.sensor_T_imu.translation - Eigen::Vector3d(-2.441e-3, -9.725e-3, 7.533e-3)).norm(), 1e-9);
  EXPECT_EQ(d.body_T_sensor.translation.z(), 3);
}

TEST(LidarModels, aFileOfNoFamilyIsRefusedWithWhatWouldBeRead)
{
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "calibration.csv").string();
  std::ofstream(path) << "Laser id,Elevation\n1,14.5\n";
  try
  {
    makeDecoder(path, Rigid::identity());
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& e)
  {
    EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr("calibration.csv"), testing::HasSubstr("Ouster")));
  }
  EXPECT_THROW(makeDecoder((folder.path() / "missing.json").string(), Rigid::identity()), std::invalid_argument);
}
}  // namespace scanloom::lidar_models_unittest
