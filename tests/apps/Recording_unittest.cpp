/** A recording on the command line, without a configuration. */
#include "base/formats/TrajectoryReader.h"
#include "input/packets/CaptureReader.h"
#include "input/rawlogs/Conversions.h"
#include "support/PacketRawlogFile.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/runProgram.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace scanloom::recording_unittest
{
namespace
{
using testing::AllOf;
using testing::HasSubstr;

Ended scanloom(const std::filesystem::path& in, const std::string& command)
{
  return runProgram(fmt::format("cd {} && {}/scanloom {} 2>&1", in.string(), SCANLOOM_BIN_DIR, command));
}

const std::string kVelodynes = "other-lidars/MRPT+mrpt/modules/mrpt_data/tests/sample_velodyne_hdl32.pcap";
}  // namespace

TEST(Recording, aCaptureAloneGivesATrajectoryAndAMapWithoutAnImu)
{
  SCANLOOM_NEEDS_DATA(capture, kVelodynes);
  const TemporaryFolder folder;
  std::filesystem::copy(capture, folder / "street.pcap");
  std::filesystem::copy(SCANLOOM_SOURCE_DIR "/params/lidars/velodyne_hdl32e.json", folder / "velodyne.json");
  const Ended ended = scanloom(folder.path(), "slam street.pcap");
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("HDL-32E"), HasSubstr("there is no IMU: constant velocity")));
  EXPECT_FALSE(contentOf(folder / "street_slam/trajectory.tum").empty());
  EXPECT_TRUE(std::filesystem::exists(folder / "street_slam/map.ply"));
}

TEST(Recording, compressedIsTheSameRecording)
{
  SCANLOOM_NEEDS_DATA(capture, kVelodynes);
  const TemporaryFolder folder;
  std::filesystem::copy(SCANLOOM_SOURCE_DIR "/params/lidars/velodyne_hdl32e.json", folder / "velodyne.json");
  std::filesystem::copy(capture, folder / "plain.pcap");
  ASSERT_EQ(runProgram(fmt::format("gzip -c {0}/plain.pcap > {0}/packed.pcap.gz", folder.path().string())).status, 0);
  for (const char* name : {"plain.pcap", "packed.pcap.gz"})
    ASSERT_EQ(scanloom(folder.path(), fmt::format("record {}", name)).status, 0);
  const auto unpacked = [&](const char* name)
  { return runProgram(fmt::format("gzip -dc {}", (folder / name).string())).output; };
  EXPECT_EQ(unpacked("plain.rawlog"), unpacked("packed.rawlog"));
}

TEST(Recording, configForItRepeatsIt)
{
  SCANLOOM_NEEDS_DATA(capture, kVelodynes);
  const TemporaryFolder folder;
  std::filesystem::copy(SCANLOOM_SOURCE_DIR "/params/lidars/velodyne_hdl32e.json", folder / "velodyne.json");
  std::filesystem::copy(capture, folder / "street.pcap");
  ASSERT_EQ(scanloom(folder.path(), "config --for street.pcap > rig.ini; test -s rig.ini").status, 0);
  ASSERT_EQ(scanloom(folder.path(), "record street.pcap").status, 0);
  ASSERT_EQ(scanloom(folder.path(), "record -c rig.ini -o again.rawlog").status, 0);
  EXPECT_EQ(contentOf(folder / "again.rawlog"), contentOf(folder / "street.rawlog"));
}

TEST(Recording, configForItNamesFilesFromTheFolderThatItIsWrittenTo)
{
  SCANLOOM_NEEDS_DATA(capture, kVelodynes);
  const TemporaryFolder folder;
  for (const char* name : {"data", "rigs"}) std::filesystem::create_directory(folder / name);
  std::filesystem::copy(SCANLOOM_SOURCE_DIR "/params/lidars/velodyne_hdl32e.json", folder / "data/velodyne.json");
  std::filesystem::copy(capture, folder / "data/street.pcap");
  ASSERT_EQ(scanloom(folder.path(), "config --for data/street.pcap > rigs/rig.ini; test -s rigs/rig.ini").status, 0);
  EXPECT_THAT(contentOf(folder / "rigs/rig.ini"), HasSubstr("= ../data/velodyne.json\n"));
  const Ended recorded =
      scanloom("/", fmt::format("record -c {0}/rigs/rig.ini -o {0}/a.rawlog", folder.path().string()));
  EXPECT_EQ(recorded.status, 0) << recorded.output;
}

TEST(Recording, configForItLooksForTheMachineFromAnyFolder)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "rigs");
  ASSERT_EQ(
      scanloom(folder.path(),
               "simulate --set simulated_drive.duration=9 --set simulated_lidars.lidar1_model=OS0-16 --out-dir drive")
          .status,
      0);
  const Ended ended = scanloom(folder.path(), "config --for drive > rigs/rig.ini");
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(contentOf(folder / "rigs/rig.ini"), HasSubstr("[crop]"));
}

TEST(Recording, isReadFromAnotherFolderByItsOwnConfiguration)
{
  SCANLOOM_NEEDS_DATA(capture, kVelodynes);
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "data/results");
  std::filesystem::copy(capture, folder / "data/street.pcap");
  ASSERT_EQ(scanloom(folder / "data", "config --for street.pcap > rig.ini; test -s rig.ini").status, 0);
  const Ended ended = scanloom(folder.path(), "slam -c data/rig.ini --out-dir data/results");
  EXPECT_EQ(ended.status, 0) << ended.output;
  const Ended again = scanloom(
      "/", fmt::format("slam -c {0}/data/results/configuration.ini --out-dir {0}/again", folder.path().string()));
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_EQ(contentOf(folder / "data/results/trajectory.tum"), contentOf(folder / "again/trajectory.tum"));
}

TEST(Recording, asARawlogOfStockMrptGivesTheSameTrajectory)
{
  SCANLOOM_NEEDS_DATA(capture, kVelodynes);
  const TemporaryFolder folder;
  std::filesystem::copy(capture, folder / "street.pcap");
  CaptureReader reader(capture);
  std::vector<mrpt::serialization::CSerializable::Ptr> scans;
  for (Datagram datagram; reader.next(datagram);)
    scans.push_back(velodyneScan({datagram.payload}, toMrpt(datagram.received), "VELODYNE"));
  writeRawlog(folder / "stock.rawlog", scans);

  for (const char* name : {"street.pcap", "stock.rawlog"})
  {
    const Ended ended = scanloom(folder.path(), fmt::format("slam {}", name));
    EXPECT_EQ(ended.status, 0) << ended.output;
  }
  EXPECT_EQ(contentOf(folder / "stock_slam/trajectory.tum"), contentOf(folder / "street_slam/trajectory.tum"));

  EXPECT_EQ(scanloom(folder.path(), "record stock.rawlog").status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "stock_scans.rawlog"));
  EXPECT_EQ(scanloom(folder.path(), "view stock.rawlog --png scan.png").status, 0);
}

TEST(Recording, cloudsOfItGiveItsTrajectory)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const TemporaryFolder folder;
  ASSERT_EQ(scanloom(folder.path(), "record " + recording.string() + " -o drive.rawlog").status, 0);
  ASSERT_EQ(scanloom(folder.path(), "edit -i drive.rawlog --export ply=clouds").status, 0);
  const std::string options = " --every-nth 5 --set output.maps=false --out-dir ";
  const Ended ended = scanloom(folder.path(), "slam clouds/lidar" + options + "of_clouds");
  EXPECT_EQ(ended.status, 0) << ended.output;
  ASSERT_EQ(scanloom(folder.path(), "slam drive.rawlog --set slam.imu=none" + options + "of_rawlog").status, 0);

  const Trajectory of_clouds = readTrajectory(folder / "of_clouds/trajectory.tum");
  const Trajectory of_rawlog = readTrajectory(folder / "of_rawlog/trajectory.tum");
  ASSERT_EQ(of_clouds.size(), of_rawlog.size());
  const auto place = [](const Trajectory& poses) { return poses.back().map_T_body.translation; };
  EXPECT_LT((place(of_clouds) - place(of_rawlog)).norm(), 0.01);
  EXPECT_THAT(scanloom(folder.path(), "doctor clouds/lidar").output, HasSubstr("fit for SLAM"));
  EXPECT_THAT(scanloom(folder.path(), "calibrate clouds/lidar").output, HasSubstr("others the rawlog that 'record'"));
}

TEST(Recording, ofCloudsIsCountedAndMadeARawlog)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "clouds");
  for (const char* name : {"a.ply", "b.ply"})
    std::ofstream(folder / "clouds" / name) << "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty "
                                               "float y\nproperty float z\nend_header\n1 2 3\n4 5 6\n";
  EXPECT_THAT(scanloom(folder.path(), "info clouds").output, HasSubstr("2 clouds, 4 points"));
  const Ended ended = scanloom(folder.path(), "record clouds");
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(scanloom(folder.path(), "info clouds.rawlog").output, HasSubstr("2 observations, 4 points"));
}

TEST(Recording, infoFindsTheMetadataBeside)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  EXPECT_THAT(scanloom("/", "info " + recording.string()).output,
              AllOf(HasSubstr("OS-0-32 122150000151"), HasSubstr("OS-0-32 122322000615")));
}

TEST(Recording, thatIsMissingEndsWithTwoAndSaysWhatIsExpected)
{
  const Ended ended = scanloom("/", "slam nowhere.pcap");
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.output, HasSubstr("nowhere.pcap: no such file or folder"));
  EXPECT_THAT(scanloom("/", "slam -c nothing.ini").output, HasSubstr("--out-dir"));
}
}  // namespace scanloom::recording_unittest
