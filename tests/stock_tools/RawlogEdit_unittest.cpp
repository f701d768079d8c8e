#include "mrpt/observations/Observations.h"
#include "mrpt/observations/RawlogInfo.h"
#include "mrpt/observations/RawlogWriter.h"
#include "stockTool.h"

#include <gtest/gtest.h>

namespace scanloom::rawlog_edit_unittest
{
namespace
{
/** 25 scans of 1000 points and 50 IMU samples over 2.5 s. */
void writeRecording(const std::filesystem::path& path)
{
  Scan scan;
  scan.period = 100ms;
  scan.points.resize(1000);
  for (std::size_t i = 0; i < scan.points.size(); i++)
  {
    scan.points.x[i] = 0.01f * static_cast<float>(i);
    scan.points.t[i] = static_cast<std::int32_t>(i) * 99'000;
    scan.points.column[i] = static_cast<std::uint16_t>(i);
  }
  RecordingHeader header;
  header.scan_rate = 10;
  header.lidars.resize(1);
  RawlogWriter writer(path, header);
  for (int i = 0; i < 25; i++)
  {
    scan.start = fromNanoseconds(1'700'000'000'000'000'000) + i * 100ms;
    writer.write(*toObservation(scan));
    writer.write(*toObservation(ImuSample{scan.start + 20ms, {}, {}}, Rigid::identity()));
    writer.write(*toObservation(ImuSample{scan.start + 70ms, {}, {}}, Rigid::identity()));
  }
  writer.close();
}
}  // namespace

TEST(RawlogEdit, countsEveryObservationOfOurRawlogs)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-edit");
  const TemporaryFolder workplace;
  writeRecording(workplace / "some.rawlog");

  const std::string info = rawlogEdit("--info -i " + (workplace / "some.rawlog").string());

  EXPECT_EQ(occurrences(info, "lidar"), 25) << info;
  EXPECT_EQ(occurrences(info, "imu"), 50) << info;
  EXPECT_EQ(occurrences(info, ""), 1) << "the header, whose label is not stored\n" << info;
}

TEST(RawlogEdit, writesOurCloudsAsWholeAsItReadThem)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-edit");
  const TemporaryFolder workplace;
  writeRecording(workplace / "some.rawlog");

  rawlogEdit("--remove-label imu -i " + (workplace / "some.rawlog").string() + " -o " +
             (workplace / "kept.rawlog").string());

  const RawlogInfo info = rawlogInfo(workplace / "kept.rawlog");
  EXPECT_EQ(info.damage, "");
  EXPECT_TRUE(info.header) << "still the first object";
  ASSERT_EQ(info.sensors.size(), kStockFiltersRemove ? 1u : 2u) << "scans, and the IMU that it does not remove";
  EXPECT_EQ(info.sensors.back().count, 25u);
  EXPECT_EQ(info.sensors.back().points, 25'000u);
  EXPECT_EQ(info.sensors.back().cloud_class, "mrpt::maps::CGenericPointsMap");
}
}  // namespace scanloom::rawlog_edit_unittest
