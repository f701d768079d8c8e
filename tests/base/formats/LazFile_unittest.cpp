#include "base/formats/internal/LazFile.h"

#include "base/core/ConfigError.h"
#include "base/formats/CloudWriter.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>

#include <iterator>

#if __has_include(<laszip_api.h>)
#include <laszip_api.h>
#endif

namespace scanloom::laz_file_unittest
{
namespace
{
TEST(LazFile, isRefusedWhereThereIsNoLaszip)
{
  if (hasLaszip()) GTEST_SKIP() << "built with LASzip";
  EXPECT_THAT([] { CloudWriter("a.laz"); }, testing::ThrowsMessage<UsageError>(testing::HasSubstr("write a .las")));
}

#if __has_include(<laszip_api.h>)
constexpr int kPoints = 1000;

/** A point a millisecond and a centimetre after the other. */
void writeLine(const std::filesystem::path& file)
{
  PointCloud point;
  point.resize(1);
  point.intensity[0] = 200;
  point.ring[0] = 127;
  point.sensor_id[0] = 3;
  CloudWriter writer(file);
  for (int i = 0; i < kPoints; ++i)
    writer.add(point, Timestamp{} + i * 1ms, Rigid::fromXyzYawPitchRoll(0.01 * i, -2, 7, 0, 0, 0));
  writer.close();
}

TEST(LazFile, holdsThePointsForOtherReadersInAQuarterOfTheBytes)
{
  const TemporaryFolder folder;
  writeLine(folder / "a.las");
  writeLine(folder / "a.laz");
  EXPECT_LT(4 * std::filesystem::file_size(folder / "a.laz"), std::filesystem::file_size(folder / "a.las"));
  const std::filesystem::directory_iterator files(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 2) << "nothing else is left";

  laszip_POINTER reader = nullptr;
  laszip_BOOL is_compressed = 0;
  laszip_header_struct* header = nullptr;
  laszip_point_struct* point = nullptr;
  laszip_create(&reader);
  ASSERT_EQ(laszip_open_reader(reader, (folder / "a.laz").c_str(), &is_compressed), 0);
  laszip_get_header_pointer(reader, &header);
  laszip_get_point_pointer(reader, &point);
  EXPECT_TRUE(is_compressed);
  EXPECT_STREQ(header->generating_software, "scanloom");
  EXPECT_EQ(header->point_data_format, 6);
  EXPECT_EQ(header->max_x, 0.01 * (kPoints - 1));
  ASSERT_EQ(header->extended_number_of_point_records, kPoints);
  double first_time = 0;
  for (int i = 0; i < kPoints; ++i)
  {
    ASSERT_EQ(laszip_read_point(reader), 0);
    if (i == 0) first_time = point->gps_time;
    EXPECT_EQ(point->X, 10 * i);
    EXPECT_EQ(point->Y, -2000);
    EXPECT_EQ(point->Z, 7000);
    EXPECT_EQ(point->intensity, 200 * 257);
    EXPECT_EQ(point->user_data, 127);
    EXPECT_EQ(point->point_source_ID, 4);
    EXPECT_EQ(point->extended_scanner_channel, 3);
    EXPECT_NEAR(point->gps_time - first_time, 0.001 * i, 1e-6);
  }
  laszip_close_reader(reader);
  laszip_destroy(reader);
}
#endif
}  // namespace
}  // namespace scanloom::laz_file_unittest
