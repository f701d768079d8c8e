#include "formats/PlyWriter.h"

#include "core/Bytes.h"
#include "formats/CloudFile.h"
#include "support/TemporaryFolder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

namespace scanloom
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

TEST(PlyWriter, writesPositionsInTheFrameOfTheMapAndTheRestAsItIs)
{
  const TemporaryFolder folder;
  PlyWriter writer(folder / "a.ply");
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

TEST(PlyWriter, hasTwentySevenBytesAVertexAfterItsHeader)
{
  const TemporaryFolder folder;
  PlyWriter writer(folder / "a.ply");
  for (int i = 0; i < 12; ++i) writer.add(onePoint(), Timestamp{}, Rigid::identity());
  writer.close();

  const std::string file = contentOf(folder / "a.ply");
  EXPECT_THAT(file, HasSubstr("\nelement vertex 12\nproperty float x\n"));
  EXPECT_EQ(verticesOf(file).size(), 12U * 27U);
}

TEST(PlyWriter, mayBeEmpty)
{
  const TemporaryFolder folder;
  PlyWriter(folder / "a.ply").close();

  EXPECT_TRUE(readCloud(folder / "a.ply").points.empty());
}
}  // namespace
}  // namespace scanloom
