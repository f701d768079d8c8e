/**
 * Files of one MRPT under all others. written_by_mrpt_2.5.8.* are what these tests write, written under MRPT 2.5.8
 * (Debian 12). What is written under a newer MRPT is the same bytes; from 2.15 on not in a rawlog, whose clouds are
 * then of MRPT's own class, with other options: written_by_mrpt_2.15.14.rawlog has the same content.
 */
#include "mrpt/edit/smallRawlog.h"
#include "mrpt/maps/SceneFile.h"
#include "mrpt/maps/SimpleMapFile.h"
#include "mrpt/maps/SimpleMapReader.h"
#include "mrpt/observations/RawlogReader.h"

#include <gtest/gtest.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/version.h>

namespace scanloom::written_by_mrpt258_unittest
{
namespace
{
const std::filesystem::path kWrittenByMrpt258 = SCANLOOM_SOURCE_DIR "/tests/mrpt/edit/written_by_mrpt_2.5.8";

std::filesystem::path older(const std::string& extension)
{
  std::filesystem::path path = kWrittenByMrpt258;
  return path += extension;
}

constexpr bool kCloudsAreOurs = MRPT_VERSION < 0x20f00;

std::vector<MountedLidar> lidarsOfHeader()
{
  std::vector<MountedLidar> lidars;
  for (const RecordedLidar& lidar : someHeader().lidars) lidars.push_back({lidar.name, lidar.body_T_sensor});
  return lidars;
}

Keyframe someKeyframe()
{
  return {kSmallStart, Rigid::fromXyzYawPitchRoll(7, 8, 9, 0.5, 0.25, -0.125), someScan(kSmallStart).points};
}

MrptScene::Ptr someScene()
{
  SceneBuilder scene;
  scene.addKeyframe(someKeyframe());
  scene.addPath(straightOn());
  return scene.finished();
}

std::filesystem::path writeSimpleMap(const std::filesystem::path& path)
{
  SimpleMapWriter writer(path, lidarsOfHeader(), CloudClass::CPointsMapXYZI);
  writer.add({someKeyframe()});
  writer.close();
  return path;
}

using WrittenByMrpt = testing::TestWithParam<const char*>;
INSTANTIATE_TEST_SUITE_P(Version, WrittenByMrpt, testing::Values("2.5.8", "2.15.14"));

TEST_P(WrittenByMrpt, aRawlogIsReadWithEveryField)
{
  RawlogReader reader(std::string(SCANLOOM_SOURCE_DIR "/tests/mrpt/edit/written_by_mrpt_") + GetParam() + ".rawlog");
  std::size_t scans = 0, samples = 0;
  while (const auto event = reader.next())
  {
    const auto* recorded = std::get_if<RecordedScan>(&*event);
    if (!recorded && ++samples > 0) continue;
    const Scan& read = recorded->scan;
    const Scan written = someScan(kSmallStart + 100ms * static_cast<int>(scans++));
    EXPECT_EQ(read.start, written.start);
    if (scans == 4) continue;  // empty
    EXPECT_EQ(read.points.x, written.points.x);
    EXPECT_EQ(read.points.y, written.points.y);
    EXPECT_EQ(read.points.z, written.points.z);
    EXPECT_EQ(read.points.intensity, written.points.intensity);
    EXPECT_EQ(read.points.ring, written.points.ring);
    EXPECT_EQ(read.points.column, written.points.column);
    EXPECT_EQ(read.points.sensor_id, written.points.sensor_id);
    for (std::size_t i = 0; i < written.points.size(); ++i)
      EXPECT_NEAR(read.points.t[i], written.points.t[i], 4) << "ns, kept as float";
  }
  EXPECT_EQ(reader.damage(), "");
  EXPECT_EQ(scans, 4U);
  EXPECT_EQ(samples, 12U);
  ASSERT_TRUE(reader.header());
  ASSERT_EQ(reader.header()->lidars.size(), 2U);
  EXPECT_EQ(reader.header()->lidars[1].serial, someHeader().lidars[1].serial);
}

TEST(WrittenByMrpt258, theSameRawlogIsWrittenByThisMrpt)
{
  if (!kCloudsAreOurs) GTEST_SKIP() << "MRPT's own clouds have other options";
  const TemporaryFolder folder;
  EXPECT_TRUE(uncompressed(writeSmallRawlog(folder / "now.rawlog")) == uncompressed(older(".rawlog")));
}

TEST(WrittenByMrpt258, aRawlogPassesThroughEditUnchanged)
{
  if (!kCloudsAreOurs) GTEST_SKIP() << "MRPT's own clouds have other options";
  const TemporaryFolder folder;
  edited(
      older(".rawlog"), [](const ObservationPtr& o) { return o ? Observations{o} : Observations{}; },
      folder / "edited.rawlog");
  EXPECT_TRUE(uncompressed(folder / "edited.rawlog") == uncompressed(older(".rawlog")));
}

TEST(WrittenByMrpt258, aSimpleMapIsReadWithLidarsAndIntensities)
{
  const SimpleMapReader reader(older(".simplemap"));
  ASSERT_EQ(reader.size(), 1U);
  ASSERT_EQ(reader.lidars().size(), 2U);
  EXPECT_EQ(reader.lidars()[1].name, "right");

  // By lidar, one after the other.
  const Keyframe read = reader.keyframe(0), written = someKeyframe();
  ASSERT_EQ(read.points.size(), written.points.size());
  EXPECT_EQ(read.stamp, written.stamp);
  EXPECT_LT(boxMinus(read.map_T_body, written.map_T_body).norm(), 1e-9);
  std::size_t next = 0;
  for (std::uint8_t lidar = 0; lidar < 2; ++lidar)
    for (std::size_t i = 0; i < written.points.size(); ++i)
    {
      if (written.points.sensor_id[i] != lidar) continue;
      EXPECT_EQ(read.points.sensor_id[next], lidar);
      EXPECT_EQ(read.points.intensity[next], written.points.intensity[i]);
      EXPECT_LT((read.points.position(next) - written.points.position(i)).norm(), 1e-5F);
      ++next;
    }
}

TEST(WrittenByMrpt258, theSameSimpleMapIsWrittenByThisMrpt)
{
  const TemporaryFolder folder;
  EXPECT_TRUE(uncompressed(writeSimpleMap(folder / "now.simplemap")) == uncompressed(older(".simplemap")));
}

TEST(WrittenByMrpt258, aSceneIsWrittenInGzipByThisMrpt)
{
  const TemporaryFolder folder;
  writeScene(folder / "now.3Dscene", *someScene());
  EXPECT_NE(uncompressed(folder / "now.3Dscene").find("CPointCloudColoured"), std::string::npos);
}

TEST(WrittenByMrpt258, aSceneIsReadWithItsPointsAndItsPath)
{
  const auto read = MrptScene::Create();
  ASSERT_TRUE(read->loadFromFile(older(".3Dscene").string()));
  const auto points = read->getByClass<mrpt::opengl::CPointCloudColoured>();
  const auto written = someScene()->getByClass<mrpt::opengl::CPointCloudColoured>();
  ASSERT_TRUE(points);
  ASSERT_EQ(points->size(), written->size());
  for (std::size_t i = 0; i < points->size(); ++i) EXPECT_EQ(points->getPoint3Df(i), written->getPoint3Df(i));
  EXPECT_EQ(read->getByClass<mrpt::opengl::CSetOfLines>()->size(), 1U);
}
}  // namespace
}  // namespace scanloom::written_by_mrpt258_unittest
