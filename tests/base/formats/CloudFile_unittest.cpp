#include "base/formats/CloudFile.h"

#include "support/PointFile.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

namespace scanloom::cloud_file_unittest
{
namespace
{
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

const Eigen::Vector3f kFirst(1, -2, 3.5), kSecond(0.25, 100, -7);

template <typename T>
std::string bytes(T value)
{
  std::string text(sizeof value, '\0');
  std::memcpy(text.data(), &value, sizeof value);
  return text;
}

template <typename T>
std::string swapped(T value)
{
  std::string text = bytes(value);
  std::reverse(text.begin(), text.end());
  return text;
}

struct CloudFiles : testing::Test
{
  TemporaryFolder folder;

  CloudFile read(const std::string& name, const std::string& content) const
  {
    std::ofstream(folder / name, std::ios::binary) << content;
    return readCloud(folder / name);
  }
  void refuses(const std::string& name, const std::string& content, const std::string& why) const
  {
    EXPECT_THAT([&] { read(name, content); },
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr((folder / name).string() + ": "), HasSubstr(why))));
  }
  /** By the tool that everybody has. */
  std::filesystem::path gzip(const std::filesystem::path& file) const
  {
    const std::string packed = (folder / file.filename().string()).string() + ".gz";
    EXPECT_EQ(std::system(("gzip -c '" + file.string() + "' > '" + packed + "'").c_str()), 0);
    return packed;
  }
};

std::string plyHeader(const std::string& format, const std::string& vertices, const std::string& type)
{
  return "ply\r\nformat " + format + " 1.0\r\nelement vertex " + vertices + "\r\nproperty uchar red\r\nproperty " +
         type + " x\r\nproperty " + type + " y\r\nproperty " + type +
         " z\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n";
}

TEST_F(CloudFiles, arePlyInAscii)
{
  EXPECT_THAT(read("a.ply", plyHeader("ascii", "2", "float") + "9 1 -2 3.5\r\n9 0.25 1e2 -7\r\n3 0 1 1\r\n").points,
              ElementsAre(kFirst, kSecond));
}

TEST_F(CloudFiles, arePlyOfEitherEndiannessAndPrecision)
{
  const std::string face("\3\0\0\0\0\1\0\0\0\1\0\0\0", 13);
  const std::string little = "r" + bytes(1.0f) + bytes(-2.0f) + bytes(3.5f) + face;
  const std::string big = "r" + swapped(1.0) + swapped(-2.0) + swapped(3.5) + face;

  EXPECT_THAT(read("a.ply", plyHeader("binary_little_endian", "1", "float32") + little).points, ElementsAre(kFirst));
  EXPECT_THAT(read("a.PLY", plyHeader("binary_big_endian", "1", "double") + big).points, ElementsAre(kFirst));
}

TEST_F(CloudFiles, arePlyWithPropertiesInAnyOrder)
{
  EXPECT_THAT(read("a.ply",
                   "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 1\nproperty uchar red\nproperty double z\n"
                   "property float32 x\nproperty float y\nend_header\n255 3.5 1 -2\n")
                  .points,
              ElementsAre(kFirst));
}

std::string pcdHeader(const std::string& points, const std::string& data)
{
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS ring x y z _\nSIZE 2 4 8 4 1\nTYPE U F F F U\nCOUNT 1 1 1 1 3\nWIDTH " +
         points + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " + data + "\n";
}

TEST_F(CloudFiles, arePcdInAscii)
{
  const CloudFile cloud =
      read("a.pcd", pcdHeader("3", "ascii") + "7 1 -2 3.5 0 0 0\n7 nan 0 0 0 0 0\n7 .25 100 -7 0 0 0\n");

  EXPECT_THAT(cloud.points, ElementsAre(kFirst, kSecond));
  EXPECT_EQ(cloud.dropped, 1U);
}

TEST_F(CloudFiles, arePcdInBinary)
{
  const auto point = [](const Eigen::Vector3f& p)
  { return "rr" + bytes(p.x()) + bytes(static_cast<double>(p.y())) + bytes(p.z()) + "___"; };

  EXPECT_THAT(read("a.pcd", pcdHeader("2", "binary") + point(kFirst) + point(kSecond)).points,
              ElementsAre(kFirst, kSecond));
}

TEST_F(CloudFiles, arePcdInCompressedBinary)
{
  // Field by field; the last field is a repeated byte: LZF's literals, then one copy of 5 from 1 back.
  const std::string literal = std::string("rrrr") + bytes(1.0f) + bytes(0.25f) + bytes(-2.0) + bytes(100.0);
  const std::string rest = bytes(3.5f) + bytes(-7.0f) + "_";
  const std::string packed = "\x1b" + literal + "\x08" + rest + std::string("\x60\0", 2);
  const std::string sizes = bytes(static_cast<std::uint32_t>(packed.size())) + bytes(std::uint32_t{42});

  EXPECT_THAT(read("a.pcd", pcdHeader("2", "binary_compressed") + sizes + packed).points, ElementsAre(kFirst, kSecond));
}

TEST_F(CloudFiles, areScansOfKittiWithoutWhatIsNotFinite)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const CloudFile cloud = read("a.bin", bytes(1.0f) + bytes(-2.0f) + bytes(3.5f) + bytes(0.5f) + bytes(nan) +
                                            bytes(0.0f) + bytes(0.0f) + bytes(0.5f));

  EXPECT_THAT(cloud.points, ElementsAre(kFirst));
  EXPECT_EQ(cloud.dropped, 1U);
}

/** A scan of floats in the order of a lidar: azimuth by azimuth, some beams on a wall and some on the ground. */
std::string floatsOfScan(std::size_t count, const std::function<float(std::size_t)>& further)
{
  std::string content;
  for (std::size_t i = 0; i < 1200; ++i)
  {
    const float azimuth = 6.28F * static_cast<float>(i / 8) / 150;
    const Eigen::Vector3f p(10 * std::cos(azimuth), 10 * std::sin(azimuth), -2 + 0.3F * static_cast<float>(i % 8));
    for (std::size_t k = 0; k < count; ++k) content += bytes(k < 3 ? p[static_cast<Eigen::Index>(k)] : further(k * i));
  }
  return content;
}

TEST_F(CloudFiles, ofFloatsTellByTheirNumbersHowManyMakeAPoint)
{
  const auto small = [](std::size_t n) { return 0.01F * static_cast<float>(n % 100); };
  const auto large = [](std::size_t n) { return static_cast<float>(n % 255); };
  for (std::size_t count = 3; count <= 7; ++count)
    for (const auto& further : {std::function<float(std::size_t)>(small), std::function<float(std::size_t)>(large)})
    {
      const CloudFile cloud = read("a.bin", floatsOfScan(count, further));
      ASSERT_EQ(cloud.points.size(), 1200U) << count;
      EXPECT_NEAR(cloud.points[700].head<2>().norm(), 10, 1e-5) << count;
      EXPECT_EQ(cloud.note.empty(), count == 4) << cloud.note;
    }
}

TEST_F(CloudFiles, ofNumbersThatAreNoCoordinatesAreRefused)
{
  std::string nclt;  // three uint16 in 5 mm from -100 m, intensity, laser
  for (int i = 0; i < 400; ++i)
    nclt += bytes(static_cast<std::uint16_t>(20000 + i)) + bytes(std::uint16_t{20500}) + bytes(std::uint16_t{19900}) +
            bytes(static_cast<std::uint8_t>(i)) + "\x07";
  refuses("a.bin", nclt, "no scan of floats");
  refuses("a.bin", std::string(1600, 'x'), "no scan of floats");
  refuses("a.ply", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n", "git lfs pull");
}

TEST_F(CloudFiles, areRecognisedByTheirFirstBytes)
{
  EXPECT_THAT(read("scan", plyHeader("ascii", "1", "float") + "9 1 -2 3.5\n").points, ElementsAre(kFirst));
  EXPECT_THAT(read("a.bin", "ply  \n" + plyHeader("ascii", "1", "float").substr(4) + "9 1 -2 3.5\n").points,
              ElementsAre(kFirst));
}

TEST_F(CloudFiles, ofMeshesHaveNoTimesInTheirTextures)
{
  const auto textured = [&](const char* first)
  {
    return read("a.ply", std::string("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                                     "property float z\nproperty float ") +
                             first + "\nproperty float t\nend_header\n1 -2 3.5 0.5 0.25\n");
  };
  EXPECT_THAT(textured("s").times, ElementsAre());
  EXPECT_THAT(textured("intensity").times, ElementsAre(0.25));
}

TEST_F(CloudFiles, mayBeGzipped)
{
  read("a.ply", plyHeader("ascii", "1", "float") + "9 1 -2 3.5\n");
  read("a.bin", bytes(1.0f) + bytes(-2.0f) + bytes(3.5f) + bytes(0.5f));

  EXPECT_THAT(readCloud(gzip(folder / "a.ply")).points, ElementsAre(kFirst));
  EXPECT_THAT(readCloud(gzip(folder / "a.bin")).points, ElementsAre(kFirst));
}

TEST_F(CloudFiles, areRefusedByNameWhenNoFormatFits)
{
  refuses("a.xyz", "1 2 3\n", "no cloud by its name");
  refuses("a.gz", "", "no cloud by its name");
  refuses("a.ply.gz", "ply\n", "its header has no end");
  EXPECT_THAT([&] { readCloud(folder / "missing.ply"); }, ThrowsMessage<std::runtime_error>(HasSubstr("is no file")));
}

TEST_F(CloudFiles, areRefusedWhenCutShort)
{
  refuses("a.ply", plyHeader("ascii", "many\x1b", "float"), "its number of vertices is 'many?'");
  refuses("a.ply", plyHeader("ascii", "2", "float") + "9 1 -2 3.5\n9 1 2\n", "ends before its last");
  refuses("a.ply", plyHeader("binary_big_endian", "1", "double") + "123", "ends before its last");
  refuses("a.pcd", "FIELDS x y z\nSIZE 4 4 4\n", "no DATA");
  refuses("a.pcd", pcdHeader("2", "ascii") + "7 1 -2 3.5 0 0 0\n7 1 2 3 0 0\n", "ends before its last");
  refuses("a.pcd", pcdHeader("1", "binary") + "123", "ends before its last");
  refuses("a.pcd", pcdHeader("1", "binary_compressed") + "123", "ends before its last");
  refuses("a.bin", "123456789012345", "15 bytes");
  read("a.bin", floatsOfScan(4, [](std::size_t n) { return static_cast<float>(n % 7); }));
  const std::string packed = contentOf(gzip(folder / "a.bin"));
  refuses("b.bin.gz", packed.substr(0, packed.size() - 9), "cut short");
  refuses("b.bin.gz", packed.substr(0, 200) + "damage" + packed.substr(206), "damaged");
}

TEST_F(CloudFiles, thatUnpackToNothingButZerosAreRefusedWithoutTheirMemory)
{
  const std::filesystem::path packed = folder / "bomb.ply.gz";
  ASSERT_EQ(std::system(("(printf 'ply\\nformat binary_little_endian 1.0\\nelement vertex 80000000\\nproperty float "
                         "x\\nproperty float y\\nproperty float z\\nend_header\\n'; head -c 960000000 /dev/zero) | "
                         "gzip -1 > " +
                         packed.string())
                            .c_str()),
            0);
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  EXPECT_THAT([&] { readCloud(packed); }, ThrowsMessage<std::runtime_error>(HasSubstr("as no recording does")));
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 50'000) << "kB";
}

TEST_F(CloudFiles, areRefusedWhenTheirHeaderPromisesMoreThanThereIs)
{
  const std::string endless = "9999999999999999999", sizes_of_4_gb(8, '\xff');
  refuses("a.ply", plyHeader("ascii", endless, "float") + "9 1 -2 3.5\n", "ends before its last");
  refuses("a.ply", plyHeader("binary_little_endian", endless, "float") + std::string(99, 'x'), "ends before its last");
  for (const char* data : {"ascii", "binary", "binary_compressed"})
    refuses("a.pcd", pcdHeader(endless, data) + std::string(99, '\1'), "ends before its last");
  refuses("a.pcd", pcdHeader("1", "binary_compressed") + sizes_of_4_gb + std::string(99, 'x'), "ends before its last");
  const std::string four_gb = std::string("\x04\0\0\0\xff\xff\xff\xff", 8) + "\1ab\1";
  refuses("a.pcd", pcdHeader("1", "binary_compressed") + four_gb, "cannot hold all points");
}

TEST_F(CloudFiles, areRefusedWhenTheyAreNoPlyThatCanBeRead)
{
  const std::string start = "ply\nformat binary_little_endian 1.0\nelement vertex ";
  const std::string xyz = "\nproperty float x\nproperty float y\nproperty float z\n";

  refuses("a.ply", "", "does not start with 'ply'");
  refuses("a.ply", "ply\nformat binary_middle_endian 1.0\n", "binary_middle_endian");
  refuses("a.ply", "ply\nformat ascii 1.0\nelement vertex 1" + xyz + "end_header\n1 2 left\n",
          "'left' is not a number");
  refuses("a.ply", "ply\nformat ascii 1.0\nelement vertex 99999999999999999\nend_header\n", "no properties");
  refuses("a.ply", start + "2" + xyz, "header has no end");
  refuses("a.ply", start + "2" + xyz + "end_header\n012345678901", "ends before its last vertex");
  refuses("a.ply", start + "many" + xyz + "end_header\n", "a.ply");
  refuses("a.ply", start + "0\nproperty float x\nend_header\n", "lack x, y or z");
  refuses("a.ply", start + "1\nproperty list uchar int x\nend_header\n", "type 'list'");
}

TEST_F(CloudFiles, areRefusedWhenTheirContentContradictsTheirHeader)
{
  const std::string points = "\nPOINTS 1\nDATA ascii\n1 2 3\n";
  refuses("a.pcd", "FIELDS x y\nSIZE 4 4\nTYPE F F" + points, "lack x, y or z");
  refuses("a.pcd", "FIELDS x y z\nSIZE 4 4 2\nTYPE F F F" + points, "neither float nor double");
  refuses("a.pcd", "FIELDS x y z\nSIZE 4 4" + points, "fewer sizes");
  refuses("a.pcd", "FIELDS x y z\nSIZE 4 4 -4" + points, "SIZE '-4'");
  refuses("a.pcd", "FIELDS x y z\nSIZE 4 4 4\nDATA ascii\n1 2 3\n", "no POINTS");
  refuses("a.pcd", "FIELDS x y z\nPOINTS 1\nDATA ascii\n1 2 1e999\n", "'1e999' is not a number");
  refuses("a.pcd", pcdHeader("1", "telepathy"), "'telepathy'");
  const auto compressed = [](const std::string& packed)
  {
    return pcdHeader("1", "binary_compressed") + bytes(static_cast<std::uint32_t>(packed.size())) + bytes(21u) + packed;
  };
  refuses("a.pcd", compressed(std::string("\x20\5", 2)), "damaged");
  refuses("a.pcd",
          compressed("\x0f"
                     "abc"),
          "cut short");
  refuses("a.pcd", compressed(std::string("\0a", 2)), "another size");
  refuses("a.pcd", compressed(""), "another size");
  refuses("a.pcd", compressed("\x1f" + std::string(32, 'a')), "another size");
}

TEST(RecordedClouds, haveTheirPublishedPoints)
{
  SCANLOOM_NEEDS_DATA(folder, "registration/koide3+small_gicp/data");
  const CloudFile source = readCloud(folder / "source.ply");

  EXPECT_EQ(source.points.size(), 69792U);
  EXPECT_EQ(readCloud(folder / "target.ply").points.size(), 69088U);

  const std::string file = contentOf(folder / "source.ply");
  Eigen::Vector3f last;
  std::memcpy(last.data(), &file[file.size() - 4 * sizeof(float)], sizeof last);  // x y z intensity
  EXPECT_EQ(source.points.back(), last);
}

TEST(RecordedClouds, areReadFromCompressedPcd)
{
  SCANLOOM_NEEDS_DATA(file,
                      "odometry/PJLab-ADG+SensorsCalibration/lidar2imu/auto_calib/data/top_center_lidar/"
                      "2021-10-26-16-21-29-868.pcd");
  const CloudFile cloud = readCloud(file);

  EXPECT_GT(cloud.points.size(), 80000U);
  EXPECT_EQ(cloud.points, readPcd(file));
}

TEST(RecordedClouds, areReadFromGzippedKitti)
{
  SCANLOOM_NEEDS_DATA(file, "registration/MRPT+mrpt/modules/mrpt_data/tests/kitti_00_000000.bin.gz");
  const CloudFile cloud = readCloud(file);
  const auto range = [](const auto& a, const auto& b) { return a.norm() < b.norm(); };

  EXPECT_EQ(cloud.points.size(), 124668U);
  EXPECT_LT(std::max_element(cloud.points.begin(), cloud.points.end(), range)->norm(), 130);  // m, the HDL-64E's reach
}
}  // namespace
}  // namespace scanloom::cloud_file_unittest
