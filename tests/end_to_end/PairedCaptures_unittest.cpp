// Two real captures of different Ousters put onto one clock: real packets, artificial timing. No public recording has
// full turns of two Ousters at once.
#include <gtest/gtest.h>

#include "input/lidar/LidarModels.h"
#include "input/packets/CaptureReader.h"
#include "input/packets/CaptureWriter.h"
#include "input/rig/internal/RigReplay.h"
#include "mrpt/observations/RawlogReader.h"
#include "mrpt/observations/RawlogWriter.h"
#include "mrpt/observations/RigObservations.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"

namespace scanloom::paired_captures_unittest
{
namespace
{
const std::string kFolder = "ouster/ouster-lidar+ouster-sdk/tests/pcaps/";

struct Sensor
{
  std::filesystem::path capture, metadata;
  std::uint16_t lidar_port = 0, imu_port = 0;
};

/** The sensor stamps' distance from the record times, by the first lidar packet. */
Duration clockOffset(const Sensor& sensor)
{
  const auto decoder = makeDecoder(sensor.metadata.string(), Rigid::identity());
  CaptureReader reader(sensor.capture);
  std::vector<MeasurementBlock> blocks;
  for (Datagram datagram; reader.next(datagram);)
    if (decoder->kind(datagram.payload) == PacketKind::Lidar)
    {
      decoder->readBlocks(datagram.payload, blocks);
      return blocks.back().stamp - datagram.received;
    }
  return Duration{0};
}

/** Copies a capture to other ports, its first record at `start`. Returns how much later its records are now. */
Duration copyTo(const std::filesystem::path& path, const Sensor& sensor, Timestamp start)
{
  CaptureReader reader(sensor.capture);
  CaptureWriter writer(path);
  std::optional<Duration> shift;
  for (Datagram datagram; reader.next(datagram);)
  {
    if (!shift) shift = start - datagram.received;
    datagram.received += *shift;
    datagram.destination_port = datagram.destination_port == 7502 ? sensor.lidar_port : sensor.imu_port;
    writer.write(datagram);
  }
  writer.close();
  return *shift;
}
}  // namespace

TEST(PairedCaptures, twoRealOustersBecomeOneRawlogWithExactCounts)
{
  SCANLOOM_NEEDS_DATA(os1, kFolder + "OS-1-128_v2.3.0_1024x10_lb_n3.pcap");
  SCANLOOM_NEEDS_DATA(os1_json, kFolder + "OS-1-128_v2.3.0_1024x10.json");
  SCANLOOM_NEEDS_DATA(os2, kFolder + "OS-2-128-U1_v2.3.0_1024x10.pcap");
  SCANLOOM_NEEDS_DATA(os2_json, kFolder + "OS-2-128-U1_v2.3.0_1024x10.json");
  const TemporaryFolder folder;
  const std::vector<Sensor> sensors{{os1, os1_json, 8001, 8002}, {os2, os2_json, 9001, 9002}};
  const Timestamp start{1000s};

  std::string ini = "[rig]\ndriver = CMultiLidarSensor\npcap_input = " + (folder / "0.pcap").string() + "," +
                    (folder / "1.pcap").string() + "\n";
  for (std::size_t i = 0; i < sensors.size(); ++i)
  {
    const Duration shift =
        copyTo(folder / (std::to_string(i) + ".pcap"), sensors[i], start + 37ms * static_cast<int>(i));
    const std::string lidar = "lidar" + std::to_string(i + 1) + "_";
    ini += lidar + "metadata = " + sensors[i].metadata.string() + "\n" + lidar + "pose = [0 0 0 0 0 0]\n";
    ini += lidar + "port = " + std::to_string(sensors[i].lidar_port) + "\n" + lidar +
           "imu_port = " + std::to_string(sensors[i].imu_port) + "\n";
    ini += lidar + "time_offset = " + std::to_string(seconds(shift - clockOffset(sensors[i]))) + "\n";
  }

  const Rig rig = makeRig(readRigSettings(Configuration::fromText(ini, "test.ini"), "rig"));
  RawlogWriter writer(folder / "paired.rawlog", recordingHeader(rig), {});
  RigReplay replay(rig);
  std::uint64_t columns = 0, points = 0;
  Timestamp previous = Timestamp::min();
  while (const auto event = replay.next())
  {
    writer.write(*toObservation(*event, replay.setup(), DriverOptions{}));
    if (const auto* scan = std::get_if<Scan>(&*event))
    {
      for (const Column& column : scan->columns)
      {
        EXPECT_GE(column.stamp, previous);
        previous = column.stamp;
      }
      columns += scan->columns.size();
      points += scan->points.size();
    }
  }
  writer.close();

  const RigAccount account = replay.account();
  const LidarCounters &first = account.lidars[0].counters, &second = account.lidars[1].counters;
  EXPECT_EQ(first.received, 3u * 1024u);
  EXPECT_EQ(second.received, 1024u);
  EXPECT_EQ(columns, first.emitted + second.emitted);
  EXPECT_EQ(points, first.points + second.points);
  for (const LidarCounters& c : {first, second})
  {
    EXPECT_EQ(c.received, c.emitted + c.before_start + c.invalid);
    EXPECT_GT(c.emitted, 0u);
    EXPECT_EQ(c.lost, 0u);
  }

  RawlogReader reader(folder / "paired.rawlog");
  ASSERT_TRUE(reader.header());
  EXPECT_EQ(reader.header()->lidars[0].model, "OS-1-128");
  EXPECT_EQ(reader.header()->lidars[1].model, "OS-2-128");
  std::uint64_t read_points = 0;
  std::vector<std::uint64_t> points_of(2);
  while (const auto event = reader.next())
    if (const auto* recorded = std::get_if<RecordedScan>(&*event))
    {
      read_points += recorded->scan.points.size();
      for (const std::uint8_t id : recorded->scan.points.sensor_id) ++points_of.at(id);
    }
  EXPECT_EQ(read_points, points);
  EXPECT_EQ(points_of[0], first.points);
  EXPECT_EQ(points_of[1], second.points);
}
}  // namespace scanloom::paired_captures_unittest
