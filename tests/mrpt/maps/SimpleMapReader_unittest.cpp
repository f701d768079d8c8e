#include "mrpt/maps/SimpleMapReader.h"

#include "base/formats/CompressedFile.h"
#include "input/rawlogs/Conversions.h"
#include "support/TemporaryFolder.h"
#include "support/messageOf.h"
#include "support/peakMemory.h"

#include <gmock/gmock.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cmath>
#include <limits>

namespace scanloom::simple_map_reader_unittest
{
namespace
{
/** As another program of MRPT's would make it: no intensity, one cloud, a pose of its own. */
void addForeign(mrpt::maps::CSimpleMap& map, const mrpt::poses::CPose3D& robot, const mrpt::poses::CPose3D& sensor)
{
  auto points = mrpt::maps::CSimplePointsMap::Create();
  points->insertPoint(1.0F, 2.0F, 3.0F);
  auto observation = mrpt::obs::CObservationPointCloud::Create();
  observation->sensorLabel = "front";
  observation->sensorPose = sensor;
  observation->pointcloud = points;
  const auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(observation);
  map.insert(mrpt::poses::CPose3DPDFGaussian::Create(robot), frame);
}

TEST(SimpleMapReader, readsWhatAnotherProgramWrote)
{
  const TemporaryFolder folder;
  mrpt::maps::CSimpleMap map;
  addForeign(map, {7, 8, 9, M_PI / 2, 0, 0}, {0, 0, 2, 0, 0, 0});
  ASSERT_TRUE(map.saveToFile((folder / "foreign.simplemap").string()));

  const SimpleMapReader reader(folder / "foreign.simplemap");
  ASSERT_EQ(reader.size(), 1U);
  ASSERT_EQ(reader.lidars().size(), 1U);
  EXPECT_EQ(reader.lidars()[0].name, "front");
  const Keyframe keyframe = reader.keyframe(0);
  EXPECT_EQ(keyframe.points.position(0), Eigen::Vector3f(1, 2, 5)) << "in the body frame";
  EXPECT_LT((keyframe.map_T_body * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(7, 9, 9)).norm(), 1e-9);
}

TEST(SimpleMapReader, givesBackWhatTheWriterWasGiven)
{
  const TemporaryFolder folder;
  const std::vector<MountedLidar> lidars{{"left", Rigid::fromXyzYawPitchRoll(1.5, 1.2, 2.5, 0.5, 0.2, -0.4)},
                                         {"right", Rigid::fromXyzYawPitchRoll(1.5, -1.2, 2.5, -0.5, 0.2, 0.4)}};
  Keyframe written{fromNanoseconds(1'750'000'000'000'000'100), Rigid::fromXyzYawPitchRoll(7, 8, 9, 1, 0, 0), {}};
  written.points.resize(3);
  written.points.x = {4, 5, 6};
  written.points.intensity = {51, 255, 0};
  written.points.sensor_id = {0, 1, 1};
  SimpleMapWriter writer(folder / "keyframes.simplemap", lidars);
  writer.add({written});
  writer.close();

  const SimpleMapReader reader(folder / "keyframes.simplemap");
  ASSERT_EQ(reader.lidars().size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_EQ(reader.lidars()[i].name, lidars[i].name);
    EXPECT_LT(boxMinus(reader.lidars()[i].body_T_sensor, lidars[i].body_T_sensor).norm(), 1e-9) << "where rays start";
  }
  const Keyframe read = reader.keyframe(0);
  EXPECT_EQ(read.stamp, written.stamp);
  EXPECT_EQ(read.points.sensor_id, written.points.sensor_id);
  EXPECT_EQ(read.points.intensity, written.points.intensity);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT((read.points.position(i) - written.points.position(i)).norm(), 1e-5F);
}

TEST(SimpleMapReader, refusesALidarThatMovedAndFilesThatAreNone)
{
  const TemporaryFolder folder;
  mrpt::maps::CSimpleMap map;
  addForeign(map, {}, {0, 0, 2, 0, 0, 0});
  addForeign(map, {}, {0, 0, 3, 0, 0, 0});
  map.saveToFile((folder / "moved.simplemap").string());
  std::ofstream(folder / "text.simplemap") << "no map";

  EXPECT_THROW(SimpleMapReader(folder / "moved.simplemap"), std::runtime_error);
  EXPECT_THROW(SimpleMapReader(folder / "text.simplemap"), std::runtime_error);
  EXPECT_THROW(SimpleMapReader(folder / "nowhere.simplemap"), std::runtime_error);
}

std::string refusalOf(const std::filesystem::path& path)
{
  return messageOf<std::runtime_error>([&] { SimpleMapReader reader(path); });
}

using Poses = std::vector<mrpt::poses::CPose3D>;

/** Each keyframe at one of the poses of the body, its lidar at one of the others. */
std::filesystem::path writeForeign(const TemporaryFolder& folder, const Poses& of_body, const Poses& of_lidar)
{
  mrpt::maps::CSimpleMap map;
  for (std::size_t i = 0; i < of_body.size(); ++i) addForeign(map, of_body[i], of_lidar[i]);
  const auto path = folder / "foreign.simplemap";
  EXPECT_TRUE(map.saveToFile(path.string()));
  return path;
}

TEST(SimpleMapReader, namesFileAndKeyframeOfAnImpossiblePose)
{
  const TemporaryFolder folder;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  const mrpt::poses::CPose3D sound(1, 2, 3, 0, 0, 0);
  for (const double x : {nan, infinite, -infinite, 1.1e8, -3e38})
  {
    mrpt::poses::CPose3D impossible = sound;
    impossible.x(x);
    EXPECT_THAT(refusalOf(writeForeign(folder, {sound, sound, impossible}, {sound, sound, sound})),
                testing::HasSubstr("foreign.simplemap: keyframe 2 (from 0): impossible pose of the body"))
        << x;
    EXPECT_THAT(refusalOf(writeForeign(folder, {sound, sound}, {sound, impossible})),
                testing::HasSubstr("foreign.simplemap: keyframe 1 (from 0): impossible pose of the lidar 'front'"))
        << x;
  }
  mrpt::poses::CPose3D sheared = sound;
  auto rotation = sheared.getRotationMatrix();
  rotation(0, 1) = 0.5;
  sheared.setRotationMatrix(rotation);
  EXPECT_THAT(refusalOf(writeForeign(folder, {sheared}, {sound})),
              testing::HasSubstr("keyframe 0 (from 0): impossible pose of the body"));
  EXPECT_EQ(refusalOf(writeForeign(folder, {mrpt::poses::CPose3D(9.9e5, 0, 0, 0, 0, 0)}, {sound})), "");
}

TEST(SimpleMapReader, leavesOutPointsThatAreNoNumbers)
{
  const TemporaryFolder folder;
  auto points = mrpt::maps::CSimplePointsMap::Create();
  points->insertPointFast(1.0F, std::nanf(""), 3.0F);
  points->insertPointFast(4.0F, 5.0F, 6.0F);
  auto observation = mrpt::obs::CObservationPointCloud::Create();
  observation->pointcloud = points;
  const auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(observation);
  mrpt::maps::CSimpleMap map;
  map.insert(mrpt::poses::CPose3DPDFGaussian::Create(), frame);
  ASSERT_TRUE(map.saveToFile((folder / "nan.simplemap").string()));

  const Keyframe read = SimpleMapReader(folder / "nan.simplemap").keyframe(0);
  ASSERT_EQ(read.points.size(), 1U);
  EXPECT_EQ(read.points.position(0), Eigen::Vector3f(4, 5, 6));
}

/** So that a byte can be changed without a checksum that tells. */
std::string uncompressed(const std::filesystem::path& path)
{
  std::string bytes(100'000, '\0');
  bytes.resize(CompressedFile(path).readUpTo(bytes.data(), bytes.size()));
  return bytes;
}

std::string smallMap(const TemporaryFolder& folder)
{
  return uncompressed(writeForeign(folder, {{1, 2, 3, 0, 0, 0}}, {{}}));
}

std::string refusalOfBytes(const TemporaryFolder& folder, const std::string& bytes)
{
  const auto path = folder / "changed.simplemap";
  std::ofstream(path, std::ios::binary) << bytes;
  return refusalOf(path);
}

TEST(SimpleMapReader, refusesCountsThatTheFileCannotHold)
{
  const TemporaryFolder folder;
  const std::string sound = smallMap(folder);
  ASSERT_EQ(refusalOfBytes(folder, sound), "");
  constexpr std::size_t kVersion = 1;
  for (const std::string name : {"CSimpleMap", "CSensoryFrame", "CObservationPointCloud", "CSimplePointsMap"})
  {
    std::string damaged = sound;
    damaged[damaged.find(name) + name.size() + kVersion + 3] |= 0x40;  // 2^30 more
    EXPECT_THAT(refusalOfBytes(folder, damaged), testing::AllOf(testing::HasSubstr("changed.simplemap: is damaged: a "),
                                                                testing::HasSubstr(name + " of 10737418")));
  }
}

TEST(SimpleMapReader, refusesAMapThatIsCutAnywhere)
{
  const TemporaryFolder folder;
  const std::string sound = smallMap(folder);
  for (std::size_t length = 0; length < sound.size(); length += 7)
    EXPECT_NE(refusalOfBytes(folder, sound.substr(0, length)), "") << length;
}

std::string ownMap(const TemporaryFolder& folder)
{
  Keyframe keyframe{fromNanoseconds(1'750'000'000'000'000'100), Rigid::fromXyzYawPitchRoll(7, 8, 9, 1, 0, 0), {}};
  keyframe.points.resize(2);
  keyframe.points.sensor_id = {0, 1};
  SimpleMapWriter writer(folder / "own.simplemap", {{"left", {}}, {"right", {}}});
  writer.add({keyframe});
  writer.close();
  return uncompressed(folder / "own.simplemap");
}

TEST(SimpleMapReader, takesNoGigabytesForABitThatFlipped)
{
  const TemporaryFolder folder;
  const long before = peakMegabytes();
  constexpr std::size_t kStride = 9;  // one bit of nearly each byte: MRPT's exceptions take milliseconds
  for (const std::string& sound : {smallMap(folder), ownMap(folder)})
    for (std::size_t bit = 0; bit < sound.size() * 8; bit += kStride)
    {
      std::string damaged = sound;
      damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ 1 << bit % 8);
      refusalOfBytes(folder, damaged);
      ASSERT_LT(peakMegabytes() - before, 100) << "bit " << bit % 8 << " of byte " << bit / 8;
    }
}
}  // namespace
}  // namespace scanloom::simple_map_reader_unittest
