#include "input/rig/FileKind.h"

#include "support/TemporaryFolder.h"
#include "support/TestData.h"

#include <gtest/gtest.h>

namespace scanloom::file_kind_unittest
{
namespace
{
FileKind kindOfText(const std::string& text)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << text;
  return kindOf(folder / "file");
}
}  // namespace

TEST(FileKind, isToldByContentNotByName)
{
  EXPECT_EQ(kindOfText("# poses\nT_body_left 1 2 3 0 0 0\n"), FileKind::Extrinsics);
  EXPECT_EQ(kindOfText("#t [ns],wx,wy,wz,ax,ay,az\n1750000000001230000,0,0,0,0,0,9.8\n"), FileKind::BodyImu);
  EXPECT_EQ(kindOfText("{\"lidar\": \"velodyne\", \"model\": \"VLP-16\"}"), FileKind::LidarMetadata);
}

TEST(FileKind, cloudsByTheirFirstLines)
{
  EXPECT_EQ(kindOfText("ply\nformat ascii 1.0\n"), FileKind::Cloud);
  EXPECT_EQ(kindOfText("# .PCD v.7 - Point Cloud Data file format\nVERSION .7\nFIELDS x y z\n"), FileKind::Cloud);
  EXPECT_EQ(kindOfText("VERSION 0.7\nFIELDS x y z\n"), FileKind::Cloud);
  EXPECT_EQ(kindOfText("# by a driver\nFIELDS x y z\n"), FileKind::Cloud);
}

TEST(FileKind, otherTextsAreNoneOfThem)
{
  EXPECT_EQ(kindOfText(""), FileKind::Other);
  EXPECT_EQ(kindOfText("polygon\nformat ascii 1.0\n"), FileKind::Other);
  EXPECT_EQ(kindOfText("{\"drift\": 0.1}"), FileKind::Other);
  EXPECT_EQ(kindOfText("#t [s],x [m],y [m],z [m]\n1750000000.030000000,512.5769,-88.2291,48.3286\n"), FileKind::Other);
  EXPECT_EQ(kindOfText("1750000000.0 0 0 0.16 0 0 0 1\n"), FileKind::Other);
}

TEST(FileKind, ofStrangersFiles)
{
  SCANLOOM_NEEDS_DATA(data, "other-lidars");
  EXPECT_EQ(kindOf(data / "MRPT+mrpt/modules/mrpt_data/datasets/rot_scan_velodyne.rawlog"), FileKind::Rawlog);
  EXPECT_EQ(kindOf(data / "MRPT+mrpt/modules/mrpt_data/tests/sample_velodyne_hdl32.pcap"), FileKind::Capture);
}
}  // namespace scanloom::file_kind_unittest
