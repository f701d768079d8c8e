/** Scans at another rate. */
#include "mrpt/edit/internal/RebatchClouds.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/RawlogHeader.h"
#include "mrpt/edit/internal/RawlogLabels.h"
#include "mrpt/edit/internal/SplitLidars.h"
#include "mrpt/observations/RawlogInfo.h"
#include "smallRawlog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanloom::rebatch_clouds_unittest
{
namespace
{
using testing::ElementsAre;

struct RebatchClouds : testing::Test
{
  TemporaryFolder folder;
  std::filesystem::path in = writeSmallRawlog(folder / "in.rawlog");
  std::filesystem::path out = folder / "out.rawlog";
  std::filesystem::path back = folder / "back.rawlog";

  std::vector<std::size_t> sizes(const std::string& label = "lidar") const
  {
    std::vector<std::size_t> all;
    for (const ObservationPtr& scan : observationsIn(out, label)) all.push_back(cloudIn(scan)->pointcloud->size());
    return all;
  }
};

TEST_F(RebatchClouds, putsEachPointIntoTheScanOfItsTime)
{
  edited(in, rebatch(20, someHeader()), out);

  // Column c is 2.441403 ms x c after the start: 20 columns of three points before 50 ms, 0 to 48.8 ms.
  EXPECT_THAT(sizes(), ElementsAre(63, 57, 63, 57, 63, 57, 0, 0));
  const Observations scans = observationsIn(out, "lidar");
  EXPECT_EQ(fromMrpt(scans[1]->timestamp), kSmallStart + 50ms);
  const auto second = cloudIn(scans[1]);
  EXPECT_NEAR(genericCloudOf(*second).getPointsBufferRef_float_field("t")->front(), 21 * 0.002441403 - 0.05, 1e-8);
  EXPECT_EQ(rawlogInfo(out).header->scan_rate, 20);
}

TEST_F(RebatchClouds, backAtTheOldRateItIsTheSameBytes)
{
  for (const double rate : {20.0, 50.0, 40.0})
  {
    edited(in, rebatch(rate, someHeader()), out);
    edited(out, rebatch(10, *headerOf(out)), back);
    EXPECT_TRUE(uncompressed(back) == uncompressed(in)) << rate << " Hz";
  }
}

TEST_F(RebatchClouds, backFromALowerRateScansAreTheSameBytesAndComeLater)
{
  edited(in, keepLabels({"lidar"}), in);
  for (const double rate : {5.0, 2.5})
  {
    edited(in, rebatch(rate, someHeader()), out);
    edited(out, rebatch(10, *headerOf(out)), back);
    EXPECT_TRUE(uncompressed(back) == uncompressed(in)) << rate << " Hz";
  }
}

TEST_F(RebatchClouds, aLowerRateJoinsScans)
{
  edited(in, rebatch(5, someHeader()), out);
  EXPECT_THAT(sizes(), ElementsAre(240, 120));
}

TEST_F(RebatchClouds, whereScansAreMissingNoneAreMadeUp)
{
  const auto withoutTheSecond = [count = 0](const ObservationPtr& observation) mutable -> Observations
  {
    if (!observation || (observation->sensorLabel == "lidar" && ++count == 2)) return {};
    return {observation};
  };
  edited(in, chained(withoutTheSecond, rebatch(20, someHeader())), out);
  EXPECT_THAT(sizes(), ElementsAre(63, 57, 63, 57, 0, 0));
}

TEST_F(RebatchClouds, partsOfLidarsStayApart)
{
  edited(in, chained(splitLidars(someHeader()), rebatch(5, someHeader())), out);
  EXPECT_THAT(sizes("lidar_left"), ElementsAre(120, 60));
  EXPECT_THAT(sizes("lidar_right"), ElementsAre(120, 60));
}

TEST_F(RebatchClouds, aRateThatIsNotKnownIsAnError)
{
  RecordingHeader header = someHeader();
  header.scan_rate = 0;
  EXPECT_THROW(rebatch(20, header), std::invalid_argument);
}
}  // namespace
}  // namespace scanloom::rebatch_clouds_unittest
