#include "lab/simulation/internal/AssumedOuster.h"

#include "input/lidar/OusterDecoder.h"
#include "support/TestData.h"

#include <gtest/gtest.h>

namespace scanloom::assumed_ouster_unittest
{
namespace
{
OusterUnit unit(const std::string& model)
{
  OusterUnit unit;
  unit.model = model;
  return unit;
}

struct RealUnit
{
  const char* file;
  const char* model;
};

using AssumedTables = testing::TestWithParam<RealUnit>;

TEST_P(AssumedTables, areWithinOneAndAHalfDegreesOfARealUnits)
{
  SCANLOOM_NEEDS_DATA(folder, "ouster/ouster-lidar+ouster-sdk/tests/pcaps");
  const OusterMetadata real = loadOusterMetadata((folder / GetParam().file).string());
  const OusterMetadata assumed = assumedOuster(unit(GetParam().model));
  ASSERT_EQ(assumed.channels, real.channels);
  EXPECT_NEAR(assumed.beam_to_lidar_mm(0, 3), real.beam_to_lidar_mm(0, 3), 1);
  for (int beam = 0; beam < real.channels; ++beam)
  {
    EXPECT_NEAR(assumed.beam_altitude_deg[beam], real.beam_altitude_deg[beam], 1.5) << beam;
    EXPECT_NEAR(assumed.beam_azimuth_deg[beam], real.beam_azimuth_deg[beam], 1.5) << beam;
  }
}

INSTANTIATE_TEST_SUITE_P(, AssumedTables,
                         testing::Values(RealUnit{"OS-0-128_v3.0.1_1024x10.json", "OS0-128"},
                                         RealUnit{"OS-1-128_v2.3.0_1024x10.json", "OS1-128"},
                                         RealUnit{"OS-2-128-U1_v2.3.0_1024x10.json", "OS2-128"}));

TEST(AssumedOuster, isReadByTheDecoderInEveryModeAndProfile)
{
  for (const char* model : {"OS0-32", "OS1-64", "OS-2-128"})
    for (const OusterProfile& profile : kOusterProfiles)
      for (const char* mode : {"512x10", "1024x10", "2048x10", "512x20", "1024x20"})
      {
        OusterUnit one = unit(model);
        one.mode = mode;
        one.profile = profile.name;
        const OusterMetadata metadata = assumedOuster(one);
        EXPECT_EQ(toJson(parseOusterMetadata(toJson(metadata), "x")), toJson(metadata)) << profile.name;
        EXPECT_NO_THROW(OusterDecoder(metadata, Rigid::identity())) << profile.name << mode;
      }
}

TEST(AssumedOuster, saysWhatIsWrongWithAModelAModeAndAProfile)
{
  for (const char* model : {"OS3-32", "OS0", "OS0-7", "VLP-16", ""})
    EXPECT_THROW(assumedOuster(unit(model)), std::invalid_argument);
  for (const char* mode : {"512x11", "2048x20", "1024", "x10", "1024x10 "})
  {
    OusterUnit one;
    one.mode = mode;
    EXPECT_THROW(assumedOuster(one), std::invalid_argument) << mode;
  }
  OusterUnit one;
  one.profile = "RNG19";
  EXPECT_THROW(assumedOuster(one), std::invalid_argument);
}
}  // namespace
}  // namespace scanloom::assumed_ouster_unittest
