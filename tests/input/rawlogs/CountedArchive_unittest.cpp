#include "input/rawlogs/CountedArchive.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationRotatingScan.h>

#include <fstream>
#include <string>

#include "support/TemporaryFolder.h"

namespace scanloom::counted_archive_unittest
{
namespace
{
template <typename Number>
std::string bytesOf(Number number)
{
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

std::string text(const std::string& characters)
{
  return bytesOf(static_cast<std::uint32_t>(characters.size())) + characters;
}

/** As MRPT begins an object: the length of the name with the highest bit set, the name, a version. */
std::string objectNamed(const std::string& name, char version)
{
  return static_cast<char>(0x80 | name.size()) + name + version;
}

/** Twelve numbers, as MRPT 2.5 writes a position and a rotation matrix. */
std::string pose() { return objectNamed("mrpt::poses::CPose3D", 3) + std::string(96, '\0') + '\x88'; }

/** A CObservationRotatingScan up to its image of ranges, as MRPT 2.5 writes it. */
std::string scanOf(const std::string& label)
{
  const std::string ranges_and_angles(32, '\0'), nearest_and_farthest(16, '\0'), pose(56, '\0'), received(9, '\0');
  return objectNamed("mrpt::obs::CObservationRotatingScan", 0) + bytesOf(std::uint64_t{1}) + label +
         bytesOf(std::uint16_t{16}) + bytesOf(std::uint16_t{1800}) + ranges_and_angles + text("VLP-16") +
         nearest_and_farthest + objectNamed("mrpt::poses::CPose3D", 2) + pose + '\x88' + received;
}

std::string refusedIn(const std::string& rawlog)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "scan.rawlog", std::ios::binary) << rawlog;
  CountedArchive archive(folder / "scan.rawlog");
  try
  {
    archive.ReadObject();
  }
  catch (const std::exception& e)
  {
    return archive.refused().empty() ? e.what() : archive.refused();
  }
  return "";
}
}  // namespace

/** MRPT would take the memory first: 8.6 GB for the image, 4.3 GB for the name. */
TEST(CountedArchive, aRotatingScanIsRefusedBeforeTheMemoryForWhatCannotFollowIsTaken)
{
  mrpt::obs::CObservationRotatingScan::Create();  // links the library that registers the class
  const std::string largest_image = bytesOf(std::uint16_t{65535}) + bytesOf(std::uint16_t{65535});
  EXPECT_EQ(refusedIn(scanOf(text("velodyne")) + largest_image),
            "is damaged: a CObservationRotatingScan of 4294836225 pixels, but only 0 bytes follow");
  EXPECT_EQ(refusedIn(scanOf(bytesOf(std::uint32_t{0xFFFFFFFF}))).substr(0, 68),
            "is damaged: a CObservationRotatingScan of 4294967295 characters, but");
}

TEST(CountedArchive, aRobotPoseIsRefusedBeforeTheMemoryForALabelThatCannotFollowIsTaken)
{
  mrpt::obs::CObservationRobotPose::Create();
  const std::string covariance(21 * sizeof(double), '\0');
  EXPECT_EQ(
      refusedIn(objectNamed("mrpt::obs::CObservationRobotPose", 1) + objectNamed("mrpt::poses::CPose3DPDFGaussian", 1) +
                pose() + covariance + '\x88' + bytesOf(std::uint32_t{0xFFFFFFFF})),
      "is damaged: a CObservationRobotPose of 4294967295 items, but only 0 bytes follow");
}
}  // namespace scanloom::counted_archive_unittest
