/** Rawlogs as files of other programs, read here by other code than wrote them. */
#include "mrpt/edit/internal/ExportClouds.h"

#include "base/formats/CloudFile.h"
#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/internal/ConvertClouds.h"
#include "mrpt/edit/internal/ExportTables.h"
#include "mrpt/edit/internal/SplitLidars.h"
#include "smallRawlog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <cstring>
#include <sstream>

namespace scanloom::export_clouds_unittest
{
namespace
{
using testing::HasSubstr;
using testing::StartsWith;

struct ExportClouds : testing::Test
{
  TemporaryFolder folder;
  std::filesystem::path in = writeSmallRawlog(folder / "in.rawlog", 2);
  std::filesystem::path out = folder / "out";

  void exported(const RawlogOperation& operation) const
  {
    readRawlog(in, operation, [](std::uint64_t) { return true; });
  }
};

/** The bytes behind a header that ends with `end`. */
std::string dataOf(const std::filesystem::path& path, const std::string& end)
{
  const std::string content = contentOf(path);
  return content.substr(content.find(end) + end.size());
}

template <typename T>
T at(const std::string& bytes, std::size_t offset)
{
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

TEST_F(ExportClouds, pcdHoldsAllFields)
{
  exported(exportClouds(CloudFormat::Pcd, out, someHeader()));

  const std::filesystem::path file = out / "lidar" / "000000.pcd";
  EXPECT_THAT(contentOf(file), HasSubstr("FIELDS x y z intensity t ring column sensor_id\nSIZE 4 4 4 4 8 2 2 1\n"));
  const std::string data = dataOf(file, "DATA binary\n");
  ASSERT_EQ(data.size(), 120u * 29);
  constexpr std::size_t kFifth = 4 * 29;  // point 4: column 1, ring 1
  EXPECT_FLOAT_EQ(at<float>(data, kFifth), 0.4f);
  EXPECT_FLOAT_EQ(at<float>(data, kFifth + 4), -0.2f);
  EXPECT_FLOAT_EQ(at<float>(data, kFifth + 8), 1.f);
  EXPECT_FLOAT_EQ(at<float>(data, kFifth + 12), 28.f);
  EXPECT_DOUBLE_EQ(at<double>(data, kFifth + 16), 0.002441403);
  EXPECT_EQ(at<std::uint16_t>(data, kFifth + 24), 1);
  EXPECT_EQ(at<std::uint16_t>(data, kFifth + 26), 1);
  EXPECT_EQ(data[kFifth + 28], 1);
  EXPECT_EQ(readCloud(out / "lidar" / "000001.pcd").points.size(), 0u) << "the last scan is empty";
}

TEST_F(ExportClouds, labelsNameNoFilesOutsideOfTheFolder)
{
  for (const std::string& label : {std::string("../../evil"), (folder / "evil").string(), std::string("..")})
  {
    const auto renamed = [&](const ObservationPtr& observation)
    {
      if (observation) observation->sensorLabel = label;
      return observation ? Observations{observation} : Observations{};
    };
    exported(chained(renamed, exportClouds(CloudFormat::Ply, out, someHeader())));
    exported(chained(renamed, exportCsv(out)));
    std::filesystem::remove(in);
    in = writeSmallRawlog(folder / "in.rawlog", 2);
  }
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names, testing::UnorderedElementsAre("in.rawlog", "out"));
  EXPECT_TRUE(std::filesystem::exists(out / "%2E./000000.ply"));
  EXPECT_TRUE(std::filesystem::exists(out / "%2E.%2F..%2Fevil.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path().parent_path() / "evil"));
}

TEST_F(ExportClouds, plyHoldsThePointsOfEachLabel)
{
  exported(chained(splitLidars(someHeader()), exportClouds(CloudFormat::Ply, out, someHeader())));
  const CloudFile right = readCloud(out / "lidar_right" / "000000.ply");
  ASSERT_EQ(right.points.size(), 60u);
  EXPECT_FLOAT_EQ(right.points[4].x(), 1.0f);
  EXPECT_FLOAT_EQ(right.points[4].y(), -0.6f);
}

TEST_F(ExportClouds, kittiHoldsFourFloatsAPointAndTimesBesideThem)
{
  exported(exportClouds(CloudFormat::Kitti, out, someHeader()));
  const std::string data = contentOf(out / "lidar" / "velodyne" / "000000.bin");
  ASSERT_EQ(data.size(), 120u * 16);
  EXPECT_FLOAT_EQ(at<float>(data, 4 * 16), 0.4f);
  EXPECT_FLOAT_EQ(at<float>(data, 4 * 16 + 12), 28.f / 255);
  EXPECT_EQ(contentOf(out / "lidar" / "times.txt"), "1700000000.000000000\n1700000000.100000000\n");
}

TEST_F(ExportClouds, imusBecomeEurocTables)
{
  exported(exportCsv(out));
  std::istringstream imu(contentOf(out / "imu.csv"));
  std::string heading, first;
  std::getline(imu, heading);
  std::getline(imu, first);
  EXPECT_THAT(heading, StartsWith("#timestamp [ns],w_RS_S_x [rad s^-1]"));
  EXPECT_THAT(first, StartsWith("1700000000010000000,1"));
  EXPECT_EQ(contentOf(out / "clouds.csv"),
            "#timestamp [ns],label,points\n1700000000000000000,lidar,120\n1700000000100000000,lidar,0\n");
  EXPECT_TRUE(std::filesystem::exists(out / "imu_right.csv"));
}

TEST_F(ExportClouds, odometryBecomesATrajectory)
{
  const auto withOdometry = [](const ObservationPtr& observation) -> Observations
  {
    if (!observation) return {};
    if (observation->sensorLabel != "lidar") return {observation};
    auto odometry = mrpt::obs::CObservationOdometry::Create();
    odometry->timestamp = observation->timestamp;
    odometry->sensorLabel = "odometry";
    odometry->odometry = {1.5, -2, M_PI / 2};
    return {odometry};
  };
  exported(chained(withOdometry, exportTum(folder / "o.tum")));
  EXPECT_THAT(contentOf(folder / "o.tum"), StartsWith("1700000000.000000000 1.500000000 -2.000000000 0.000000000 "
                                                      "0.000000000 0.000000000 0.707106781 0.707106781\n"));
}

TEST_F(ExportClouds, withoutPosesThereIsNoTrajectory)
{
  EXPECT_THROW(exported(exportTum(folder / "o.tum")), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "o.tum"));
}

TEST_F(ExportClouds, xyziKeepsPositionsAndIntensityFrom0To1)
{
  edited(in, convertClouds(CloudClass::CPointsMapXYZI), out);
  const auto cloud = cloudIn(observationsIn(out, "lidar").front());
  const auto xyzi = std::dynamic_pointer_cast<mrpt::maps::CPointsMapXYZI>(cloud->pointcloud);
  ASSERT_TRUE(xyzi);
  ASSERT_EQ(xyzi->size(), 120u);
  EXPECT_FLOAT_EQ(xyzi->getPointIntensity(4), 28.f / 255);

  edited(out, convertClouds(CloudClass::CGenericPointsMap), out);
  const auto back = cloudIn(observationsIn(out, "lidar").front());
  EXPECT_FLOAT_EQ((*genericCloudOf(*back).getPointsBufferRef_float_field("intensity"))[4], 28.f);
  EXPECT_FALSE(genericCloudOf(*back).hasPointField("t")) << "times that nobody knows are not 0";
}

TEST_F(ExportClouds, cloudsOfTheClassAlreadyKeepTheirBytes)
{
  edited(in, convertClouds(CloudClass::CGenericPointsMap), out);
  EXPECT_TRUE(uncompressed(out) == uncompressed(in));
}
}  // namespace
}  // namespace scanloom::export_clouds_unittest
