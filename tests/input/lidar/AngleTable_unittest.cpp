#include "input/lidar/internal/AngleTable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace scanloom::angle_table_unittest
{
TEST(AngleTable, readsRowsInAnyOrder)
{
  std::string csv = "Channel,Elevation,Azimuth\r\n";
  for (int i = 16; i >= 1; --i) csv += std::to_string(i) + "," + std::to_string(i) + ".5,-0.25\r\n";
  const AngleTable table = parseAngleTable(csv, "unit.csv", 16);
  EXPECT_EQ(table.vertical[2], 3.5);
  EXPECT_EQ(table.azimuth[2], -0.25);
}

TEST(AngleTable, takesRowsWithoutAChannelInTheirOrder)
{
  const AngleTable table = parseAngleTable("14.94,-4.05\t\n13.03,3.61\n", "unit.csv", 2);
  EXPECT_EQ(table.vertical, (std::vector<double>{14.94, 13.03}));
  EXPECT_EQ(table.azimuth, (std::vector<double>{-4.05, 3.61}));
}

TEST(AngleTable, saysWhichLineIsWrong)
{
  const auto said = [](const std::string& csv) -> std::string
  {
    try
    {
      parseAngleTable(csv, "unit.csv", 2);
      return "accepted";
    }
    catch (const std::invalid_argument& e)
    {
      return e.what();
    }
  };
  EXPECT_EQ(said("id,elevation,azimuth\n1,2,3\n"), "unit.csv:2: channel 2 of 2 has no row");
  EXPECT_EQ(said("1,2,3\n1,2,3\n"), "unit.csv:2: channel 1 has two rows");
  EXPECT_EQ(said("1,2,3\n3,2,3\n"), "unit.csv:2: channel 3 is none of 1 to 2");
  EXPECT_THAT(said("1,2,3\n2,up,3\n"),
              testing::HasSubstr("unit.csv:2: expected 'channel, vertical angle, azimuth' or"));
  EXPECT_THAT(said("Channel,Time\n1,2\n2,3\n"), testing::HasSubstr("unit.csv:2: expected"));
  EXPECT_EQ(said("1,2\n1,2\n1,2\n"), "unit.csv:3: channel 3 is none of 1 to 2");
  EXPECT_THAT(said("1,2,3\n2,nan,3\n"), testing::HasSubstr("expected"));
}
}  // namespace scanloom::angle_table_unittest
