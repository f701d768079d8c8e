#include "base/formats/CloudWriter.h"

#include "base/core/Bytes.h"
#include "base/formats/CloudFile.h"
#include "base/formats/internal/LazFile.h"
#include "support/TemporaryFolder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

namespace scanloom::cloud_writer_unittest
{
namespace
{
using testing::HasSubstr;

constexpr std::int64_t kEpoch = 1'750'000'000'000'000'000;

PointCloud onePoint()
{
  PointCloud cloud;
  cloud.resize(1);
  cloud.x[0] = 1.5F;
  cloud.y[0] = -2.25F;
  cloud.z[0] = 0.125F;
  cloud.intensity[0] = 200;
  cloud.t[0] = 123'456'789;
  cloud.ring[0] = 127;
  cloud.sensor_id[0] = 3;
  return cloud;
}

/** The bytes after the header. */
std::vector<std::uint8_t> verticesOf(const std::string& file)
{
  const std::string end = "end_header\n";
  return {file.begin() + static_cast<std::ptrdiff_t>(file.find(end) + end.size()), file.end()};
}

TEST(CloudWriter, plyHasPositionsInTheFrameOfTheMapAndTheRestAsItIs)
{
  const TemporaryFolder folder;
  CloudWriter writer(folder / "a.ply");
  writer.add(onePoint(), fromNanoseconds(kEpoch), Rigid::identity());
  writer.add(onePoint(), fromNanoseconds(kEpoch) + 3600s, Rigid::fromXyzYawPitchRoll(10, 0, 0, M_PI / 2, 0, 0));
  writer.close();

  const std::vector<Eigen::Vector3f> positions = readCloud(folder / "a.ply").points;
  ASSERT_EQ(positions.size(), 2U);
  EXPECT_EQ(positions[0], Eigen::Vector3f(1.5F, -2.25F, 0.125F));
  EXPECT_TRUE(positions[1].isApprox(Eigen::Vector3f(12.25F, 1.5F, 0.125F)));

  const std::string file = contentOf(folder / "a.ply");
  const std::vector<std::uint8_t> vertices = verticesOf(file);
  constexpr std::size_t kVertex = 27;
  EXPECT_THAT(file, HasSubstr(fmt::format("\ncomment time_origin_ns {}\n", kEpoch)));
  EXPECT_EQ(load<float>(vertices, kVertex + 12), 200.F);
  EXPECT_EQ(fromSeconds(load<double>(vertices, 16)), 123'456'789ns);
  EXPECT_EQ(fromSeconds(load<double>(vertices, kVertex + 16)), 3600s + 123'456'789ns);
  EXPECT_EQ(load<std::uint16_t>(vertices, kVertex + 24), 127);
  EXPECT_EQ(vertices.at(kVertex + 26), 3);
}

TEST(CloudWriter, plyHasTwentySevenBytesAVertexAfterItsHeader)
{
  const TemporaryFolder folder;
  CloudWriter writer(folder / "a.ply");
  for (int i = 0; i < 12; ++i) writer.add(onePoint(), Timestamp{}, Rigid::identity());
  writer.close();

  const std::string file = contentOf(folder / "a.ply");
  EXPECT_THAT(file, HasSubstr("\nelement vertex 12\nproperty float x\n"));
  EXPECT_EQ(verticesOf(file).size(), 12U * 27U);
}

/** By the tables of the LAS 1.4 specification (R15). */
TEST(CloudWriter, lasHasPointsOfFormatSixInMillimetres)
{
  const TemporaryFolder folder;
  CloudWriter writer(folder / "a.las");
  writer.add(onePoint(), fromNanoseconds(kEpoch), Rigid::identity());
  writer.add(onePoint(), fromNanoseconds(kEpoch) + 3600s, Rigid::fromXyzYawPitchRoll(10, 0, 0, M_PI / 2, 0, 0));
  writer.close();

  const std::string text = contentOf(folder / "a.las");
  const std::vector<std::uint8_t> file(text.begin(), text.end());
  ASSERT_EQ(file.size(), 375U + 2U * 30U);
  EXPECT_EQ(text.substr(0, 4), "LASF");
  EXPECT_EQ(file[24], 1);
  EXPECT_EQ(file[25], 4);
  EXPECT_EQ(load<std::uint32_t>(file, 96), 375U);  // where the points begin
  EXPECT_EQ(file[104], 6);
  EXPECT_EQ(load<std::uint16_t>(file, 105), 30);
  EXPECT_EQ(load<double>(file, 131), 0.001);
  EXPECT_EQ(load<double>(file, 179), 12.25);  // largest x
  EXPECT_EQ(load<double>(file, 187), 1.5);    // least x
  EXPECT_EQ(load<std::uint64_t>(file, 247), 2U);
  EXPECT_EQ(load<std::uint64_t>(file, 255), 2U);

  constexpr std::size_t kFirst = 375, kSecond = 405;
  EXPECT_EQ(load<std::int32_t>(file, kFirst), 1500);
  EXPECT_EQ(load<std::int32_t>(file, kFirst + 4), -2250);
  EXPECT_EQ(load<std::int32_t>(file, kSecond), 12250);
  EXPECT_EQ(load<std::uint16_t>(file, kFirst + 12), 200 * 257);
  EXPECT_EQ(file[kFirst + 15], 3 << 4);
  EXPECT_EQ(file[kFirst + 17], 127);
  EXPECT_EQ(load<std::uint16_t>(file, kFirst + 20), 4);
  constexpr double kGpsOfEpoch = 1750000000.0 - 315964800 + 18 - 1e9;
  EXPECT_NEAR(load<double>(file, kFirst + 22), kGpsOfEpoch + 0.123456789, 1e-6);
  EXPECT_NEAR(load<double>(file, kSecond + 22) - load<double>(file, kFirst + 22), 3600, 1e-6);
}

/** Tables 5 and 22 of the same. */
TEST(CloudWriter, lasNamesTheReferenceSystemOfItsCoordinates)
{
  const TemporaryFolder folder;
  const std::string wkt = "PROJCS[\"a grid\"]";
  CloudWriter writer(folder / "a.las", {500000, 6886000, 0}, wkt);
  writer.add(onePoint(), fromNanoseconds(kEpoch), Rigid::fromXyzYawPitchRoll(500000, 6886000, 0, 0, 0, 0));
  writer.close();

  const std::string text = contentOf(folder / "a.las");
  const std::vector<std::uint8_t> file(text.begin(), text.end());
  constexpr std::size_t kRecord = 375, kText = kRecord + 54;
  EXPECT_EQ(load<std::uint32_t>(file, 100), 1U);
  EXPECT_EQ(text.substr(kRecord + 2, 15), "LASF_Projection");
  EXPECT_EQ(load<std::uint16_t>(file, kRecord + 18), 2112);
  EXPECT_EQ(load<std::uint16_t>(file, kRecord + 20), wkt.size() + 1);
  EXPECT_EQ(text.substr(kText, wkt.size()), wkt);
  const auto first_point = load<std::uint32_t>(file, 96);
  EXPECT_EQ(first_point, kText + wkt.size() + 1);
  EXPECT_EQ(load<std::int32_t>(file, first_point), 1500) << "mm from the offset";
}

TEST(CloudWriter, lasRefusesWhatItCannotHold)
{
  const TemporaryFolder folder;
  CloudWriter writer(folder / "a.las");
  EXPECT_THROW(writer.add(onePoint(), Timestamp{}, Rigid::fromXyzYawPitchRoll(3e6, 0, 0, 0, 0, 0)), std::runtime_error);
}

TEST(CloudWriter, pcdIsReadBack)
{
  const TemporaryFolder folder;
  CloudWriter writer(folder / "a.pcd");
  for (int i = 0; i < 12; ++i) writer.add(onePoint(), fromNanoseconds(kEpoch), Rigid::identity());
  writer.close();
  const std::vector<Eigen::Vector3f> positions = readCloud(folder / "a.pcd").points;
  ASSERT_EQ(positions.size(), 12U);
  EXPECT_EQ(positions.back(), Eigen::Vector3f(1.5F, -2.25F, 0.125F));
}

TEST(CloudWriter, refusesAnEndingThatItDoesNotKnow) { EXPECT_THROW(CloudWriter("a.xyz"), std::invalid_argument); }

TEST(CloudWriter, mayWriteAnEmptyFile)
{
  const TemporaryFolder folder;
  for (const std::string& ending : CloudWriter::endings())
    if (ending != ".laz" || hasLaszip()) CloudWriter(folder / ("a" + ending)).close();

  EXPECT_TRUE(readCloud(folder / "a.ply").points.empty());
  EXPECT_TRUE(readCloud(folder / "a.pcd").points.empty());
  EXPECT_EQ(std::filesystem::file_size(folder / "a.las"), 375U);
}
}  // namespace
}  // namespace scanloom::cloud_writer_unittest
