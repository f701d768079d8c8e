#include "mrpt/observations/readByAll.h"

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/version.h>

#include <string>

namespace scanloom::xyzi_read_by_all_unittest
{
namespace
{
template <typename Write>
std::string written(const Write& write)
{
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  write(archive);
  return {static_cast<const char*>(stream.getRawBufferData()), static_cast<std::size_t>(stream.getTotalBytesCount())};
}

mrpt::obs::CObservationPointCloud cloudOf(const mrpt::maps::CPointsMap::Ptr& points)
{
  mrpt::obs::CObservationPointCloud cloud;
  cloud.sensorLabel = "lidar";
  cloud.timestamp = {};  // MRPT's default is now
  cloud.pointcloud = points;
  return cloud;
}

mrpt::maps::CPointsMapXYZI::Ptr twoPoints()
{
  auto points = mrpt::maps::CPointsMapXYZI::Create();
  points->resize(2);
  points->setPointFast(0, 1, 2, 3);
  points->setPointFast(1, 4, 5, 6);
  points->setPointIntensity(0, 0.75F);
  points->setPointIntensity(1, 0.25F);
  points->insertionOptions.horizontalTolerance = 0.5F;
  points->likelihoodOptions.decimation = 7;
  return points;
}
}  // namespace

TEST(XyziReadByAll, isTheBytesThatMrptItselfWroteUntil2152)
{
  if (MRPT_VERSION >= 0x20f03) GTEST_SKIP() << "MRPT writes newer options";
  for (const auto& points : {twoPoints(), mrpt::maps::CPointsMapXYZI::Create()})
    EXPECT_EQ(written([&](auto& out) { writeForAll(cloudOf(points), out); }),
              written([&](auto& out) { out << cloudOf(points); }));
}

TEST(XyziReadByAll, isReadByThisMrptWithEveryField)
{
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  writeForAll(cloudOf(twoPoints()), archive);
  stream.Seek(0);

  mrpt::obs::CObservationPointCloud read;
  archive >> read;
  const auto points = std::dynamic_pointer_cast<mrpt::maps::CPointsMapXYZI>(read.pointcloud);
  ASSERT_TRUE(points);
  ASSERT_EQ(points->size(), 2U);
  EXPECT_EQ(points->getPointsBufferRef_x(), twoPoints()->getPointsBufferRef_x());
  EXPECT_EQ(points->getPointsBufferRef_y(), twoPoints()->getPointsBufferRef_y());
  EXPECT_EQ(points->getPointsBufferRef_z(), twoPoints()->getPointsBufferRef_z());
  EXPECT_EQ(points->getPointIntensity(0), 0.75F);
  EXPECT_EQ(points->getPointIntensity(1), 0.25F);
  EXPECT_EQ(points->insertionOptions.horizontalTolerance, 0.5F);
  EXPECT_EQ(points->likelihoodOptions.decimation, 7U);
}
}  // namespace scanloom::xyzi_read_by_all_unittest
