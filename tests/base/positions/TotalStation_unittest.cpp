#include "base/positions/TotalStation.h"

#include "support/TemporaryFolder.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>

#include <fstream>

namespace scanloom::total_station_unittest
{
namespace
{
PositionTrack read(const std::string& text)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "station.csv") << text;
  return readTotalStation(folder / "station.csv");
}

std::string complaintAbout(const std::string& text)
{
  return messageOf<std::invalid_argument>([&] { read(text); });
}

TEST(TotalStation, isReadToTheNanosecond)
{
  const PositionTrack track =
      read("#t [s],x [m],y [m],z [m]\n1750000000.000000007,512.5769,-88.2291,48.3286\n\n1750000001.5, 1, 2, 3\r\n");

  ASSERT_EQ(track.size(), 2U);
  EXPECT_EQ(nanoseconds(track[0].stamp), 1750000000000000007);
  EXPECT_EQ(track[0].position, Eigen::Vector3d(512.5769, -88.2291, 48.3286));
  EXPECT_EQ(nanoseconds(track[1].stamp), 1750000001500000000);
}

TEST(TotalStation, mayHaveAHeaderWithoutMark) { EXPECT_EQ(read("time,x,y,z\n1,1,2,3\n").size(), 1U); }

TEST(TotalStation, namesFileAndLineOfWhatIsNoMeasurement)
{
  EXPECT_THAT(complaintAbout("1,1,2,3\n2,1,two,3\n"), testing::HasSubstr("station.csv:2: expected time, x, y and z"));
  EXPECT_THAT(complaintAbout("2,1,2,3\n2,1,2,3\n"),
              testing::HasSubstr("station.csv:2: stamp 2.000000000 is not after"));
  EXPECT_THROW(readTotalStation("/nowhere.csv"), std::invalid_argument);
}

TEST(TotalStation, headersGiveOrderAndUnits)
{
  const PositionTrack track = read("H (mm);Quality;Northing_mm;timestamp [ms];E [m]\n1500;7;-2000;1750000000250.5;3\n");
  ASSERT_EQ(track.size(), 1U);
  EXPECT_EQ(nanoseconds(track[0].stamp), 1750000000250500000);
  EXPECT_TRUE(track[0].position.isApprox(Eigen::Vector3d(3, -2, 1.5)));
}

TEST(TotalStation, separatorsAndDecimalCommasAreTold)
{
  const Eigen::Vector3d position(512.5, -88.25, 48);
  for (const char* text : {"1.5;512.5;-88.25;48\n", "1,5;512,5;-88,25;48\n", "1,5\t512,5\t-88,25\t48\n",
                           "1.5   512.5 -88.25 48 ignored\n", "t;x;y;z\n1,5;512,5;-88,25;48,0\n"})
  {
    const PositionTrack track = read(text);
    ASSERT_EQ(track.size(), 1U) << text;
    EXPECT_EQ(track[0].stamp, Timestamp{1500ms}) << text;
    EXPECT_EQ(track[0].position, position) << text;
  }
}

/** `date -u -d 2026-11-23T10:15:30Z +%s` gives 1795428930. */
TEST(TotalStation, timesMayBeDates)
{
  for (const char* stamp :
       {"2026-11-23T10:15:30.25Z", "2026-11-23 10:15:30,250", "2026-11-23T12:15:30.25+02:00", "1795428930.25"})
  {
    const PositionTrack track = read(std::string("time;x;y;z\n") + stamp + ";1;2;3\n");
    ASSERT_EQ(track.size(), 1U) << stamp;
    EXPECT_EQ(nanoseconds(track[0].stamp), 1795428930250000000) << stamp;
  }
  EXPECT_THAT(complaintAbout("2026-06-31T10:15:30Z,1,2,3\n"), testing::HasSubstr("station.csv:1: "));
}

TEST(TotalStation, stampsInNanosecondsKeepThemAll)
{
  const PositionTrack track = read("t_ns,x,y,z\n1750000000000000007,1,2,3\n");
  EXPECT_EQ(nanoseconds(track.at(0).stamp), 1750000000000000007);
}

TEST(TotalStation, aHeaderThatLacksAColumnOrHasAnUnknownUnitIsRefused)
{
  EXPECT_THAT(complaintAbout("t,x,y\n1,1,2,3\n"), testing::HasSubstr("station.csv:1: the header names no column z"));
  EXPECT_THAT(complaintAbout("t,x [km],y,z\n"), testing::HasSubstr("'km' is no unit"));
  EXPECT_THAT(complaintAbout("t,x,e,y,z\n"), testing::HasSubstr("another one holds the same"));
}
}  // namespace
}  // namespace scanloom::total_station_unittest
