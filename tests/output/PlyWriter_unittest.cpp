#include "output/PlyWriter.h"

#include "cloud/PlyReader.h"

#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>

namespace scanloom
{
namespace
{
using testing::HasSubstr;
using testing::ThrowsMessage;

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

TEST(PlyFile, givesBackWhatWasWritten)
{
  const TemporaryFolder folder;
  PlyWriter writer(folder / "a.ply");
  writer.add(onePoint(), fromNanoseconds(kEpoch), Rigid::identity());
  writer.add(onePoint(), fromNanoseconds(kEpoch) + 3600s, Rigid::fromXyzYawPitchRoll(10, 0, 0, M_PI / 2, 0, 0));
  writer.close();

  const PlyContent read = readPly(folder / "a.ply");

  ASSERT_EQ(read.points.size(), 2U);
  EXPECT_EQ(read.points.position(0), Eigen::Vector3f(1.5F, -2.25F, 0.125F));
  EXPECT_TRUE(read.points.position(1).isApprox(Eigen::Vector3f(12.25F, 1.5F, 0.125F)));
  EXPECT_EQ(read.points.intensity[1], 200);
  EXPECT_EQ(read.points.ring[1], 127);
  EXPECT_EQ(read.points.sensor_id[1], 3);
  EXPECT_EQ(read.stamps[0], fromNanoseconds(kEpoch + 123'456'789));
  EXPECT_EQ(read.stamps[1], fromNanoseconds(kEpoch + 123'456'789) + 3600s);
}

TEST(PlyFile, hasTwentySevenBytesAVertexAfterItsHeader)
{
  const TemporaryFolder folder;
  PlyWriter writer(folder / "a.ply");
  for (int i = 0; i < 12; ++i) writer.add(onePoint(), Timestamp{}, Rigid::identity());
  writer.close();

  const std::string file = contentOf(folder / "a.ply");
  const std::size_t body = file.find("end_header\n") + 11;
  EXPECT_THAT(file, HasSubstr("\nelement vertex 12\nproperty float x\n"));
  EXPECT_EQ(file.size() - body, 12U * 27U);
}

TEST(PlyFile, mayBeEmpty)
{
  const TemporaryFolder folder;
  PlyWriter(folder / "a.ply").close();

  EXPECT_TRUE(readPly(folder / "a.ply").points.empty());
}

TEST(PlyFile, readsForeignOnesInAsciiWithPropertiesInAnyOrder)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "a.ply") << "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 2\nproperty uchar red\n"
                                     "property double z\nproperty float32 x\nproperty float y\nelement face 0\n"
                                     "property list uchar int vertex_indices\nend_header\n255 3 1 2\n0 6 4 5\n";

  const PlyContent read = readPly(folder / "a.ply");

  ASSERT_EQ(read.points.size(), 2U);
  EXPECT_EQ(read.points.position(1), Eigen::Vector3f(4, 5, 6));
  EXPECT_TRUE(read.stamps.empty());
}

TEST(PlyFile, saysWhatItCannotRead)
{
  const TemporaryFolder folder;
  const auto refuses = [&](const std::string& content, const std::string& why)
  {
    std::ofstream(folder / "a.ply") << content;
    EXPECT_THAT([&] { readPly(folder / "a.ply"); }, ThrowsMessage<std::invalid_argument>(HasSubstr(why)));
  };
  const std::string start = "ply\nformat binary_little_endian 1.0\nelement vertex ";
  const std::string xyz = "\nproperty float x\nproperty float y\nproperty float z\n";

  refuses("", "does not start with 'ply'");
  refuses("ply\nformat binary_middle_endian 1.0\n", "binary_middle_endian");
  refuses("ply\nformat ascii 1.0\nelement vertex 99999999999999999" + xyz + "end_header\n1 2 3\n",
          "ends before its last vertex");
  refuses("ply\nformat ascii 1.0\nelement vertex 1" + xyz + "end_header\n1 2 left\n", "'left' is not a number");
  refuses("ply\nformat ascii 1.0\nelement vertex 99999999999999999\nend_header\n", "no properties");
  refuses(start + "2" + xyz, "header has no end");
  refuses(start + "2" + xyz + "end_header\n012345678901", "ends before its last vertex");
  refuses(start + "99999999999999999" + xyz + "end_header\n", "ends before its last vertex");
  refuses(start + "many" + xyz + "end_header\n", "a.ply");
  refuses(start + "0\nproperty float x\nend_header\n", "lack x, y or z");
  refuses(start + "1\nproperty list uchar int x\nend_header\n", "type 'list'");
}
}  // namespace
}  // namespace scanloom
