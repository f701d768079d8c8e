/** `scanloom record` that knows of two lidars their addresses only. */
#include "mrpt/observations/RawlogReader.h"
#include "support/ChildProcess.h"
#include "support/FakeSensor.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/UdpSender.h"

#include <gmock/gmock.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <fstream>

#include "input/lidar/OusterMetadata.h"

namespace scanloom::record_from_sensors_unittest
{
namespace
{
using nlohmann::json;
using testing::HasSubstr;

constexpr Duration kLength = 3s;

/** One of the recording's lidars as a sensor of this computer, sending to free ports. */
struct RecordedSensor
{
  RecordedSensor(const std::filesystem::path& recording, const std::string& name, std::uint16_t recorded_port,
                 const std::string& host)
    : metadata(json::parse(contentOf(recording / (name + ".json"))))
  {
    // Ports lie where the metadata have their configuration: in its section, or at the top of older files.
    json& config = metadata.contains("config_params") ? metadata["config_params"] : metadata;
    config["udp_port_lidar"] = lidar_port;
    config["udp_port_imu"] = imu_port;
    sensor.emplace(metadata.dump(), FakeSensorOptions{host});
    for (Datagram& datagram : readDatagrams(recording / "recording.pcap"))
    {
      if (datagrams.empty() && datagram.destination_port != recorded_port) continue;
      if (!datagrams.empty() && datagram.received - datagrams.front().received > kLength) break;
      if (datagram.destination_port != recorded_port && datagram.destination_port != recorded_port + 1) continue;
      datagram.destination_port = datagram.destination_port == recorded_port ? lidar_port : imu_port;
      datagrams.push_back(std::move(datagram));
    }
  }

  std::uint16_t lidar_port = freeUdpPort(), imu_port = freeUdpPort();
  json metadata;
  std::optional<FakeSensor> sensor;
  std::vector<Datagram> datagrams;
};

std::string fieldsOf(const std::string& metadata) { return toJson(parseOusterMetadata(metadata, "metadata")); }
}  // namespace

TEST(RecordFromSensors, startsKnowingOnlyTheirAddresses)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  RecordedSensor left(recording, "left", 7502, "127.0.0.2"), right(recording, "right", 7504, "127.0.0.3");
  const TemporaryFolder folder;
  const std::filesystem::path rawlog = folder / "live.rawlog";
  std::ofstream(folder / "live.ini") << fmt::format(
      "[lidars]\ndriver = CMultiLidarSensor\nprocess_rate = 100\nextrinsics = {}\npcap_output = {}\ndeadline_ms = 200\n"
      "lidar1_name = left\nlidar1_address = {}\nlidar2_name = right\nlidar2_address = {}\n",
      (recording / "extrinsics.txt").string(), (folder / "live.pcap").string(), left.sensor->address(),
      right.sensor->address());
  ChildProcess record(
      fmt::format("{}/scanloom record -c {} -o {}", SCANLOOM_BIN_DIR, (folder / "live.ini").string(), rawlog.string()),
      folder / "log.txt");
  for (int i = 0; i < 1000 && !(isReceivedOn(left.lidar_port) && isReceivedOn(right.imu_port)); ++i)
    std::this_thread::sleep_for(10ms);

  StreamOptions together;
  together.start = std::chrono::steady_clock::now() + 100ms;
  together.origin = std::min(left.datagrams.front().received, right.datagrams.front().received);
  left.sensor->stream(left.datagrams, together);
  right.sensor->stream(right.datagrams, together);
  left.sensor->waitForStream();
  right.sensor->waitForStream();
  record.send(SIGINT);
  EXPECT_EQ(record.wait(), 130) << record.log();

  std::size_t scans = 0, imu_samples = 0;
  std::array<std::size_t, 2> columns{};
  RawlogReader reader(rawlog);
  while (auto event = reader.next())
  {
    imu_samples += std::holds_alternative<RecordedImu>(*event);
    const auto* recorded = std::get_if<RecordedScan>(&*event);
    if (!recorded) continue;
    ++scans;
    for (std::size_t i : {0, 1}) columns[i] += recorded->scan.columns_of[i];
  }
  EXPECT_GE(scans, 29u) << record.log();
  EXPECT_GE(imu_samples, 500u) << "two IMUs of 100 Hz";
  for (std::size_t sent : columns)
    EXPECT_GE(sent, 27u * 512) << "3 s of 10 turns, less what was before the start: " << record.log();
  ASSERT_TRUE(reader.header());
  EXPECT_EQ(reader.header()->lidars[1].name, "right");
  EXPECT_FALSE(reader.header()->lidars[1].serial.empty());
  EXPECT_EQ(fieldsOf(contentOf(folder / "live.left.json")), fieldsOf(left.metadata.dump()));
  EXPECT_EQ(fieldsOf(contentOf(folder / "live.right.json")), fieldsOf(right.metadata.dump()));
}

TEST(RecordFromSensors, saysWhichSensorDidNotAnswerAndRecordsTheOther)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  RecordedSensor left(recording, "left", 7502, "127.0.0.2"), right(recording, "right", 7504, "127.0.0.3");
  right.sensor->set(FakeFault::Silence);
  const TemporaryFolder folder;
  std::ofstream(folder / "live.ini") << fmt::format(
      "[lidars]\ndriver = CMultiLidarSensor\nprocess_rate = 100\nextrinsics = {}\ndeadline_ms = 200\n"
      "lidar1_name = left\nlidar1_address = {}\nlidar2_name = right\nlidar2_address = {}\nlidar2_port = {}\n"
      "lidar2_imu_port = {}\n",
      (recording / "extrinsics.txt").string(), left.sensor->address(), right.sensor->address(), right.lidar_port,
      right.imu_port);
  ChildProcess record(fmt::format("{}/scanloom record -c {} -o {} --json", SCANLOOM_BIN_DIR,
                                  (folder / "live.ini").string(), (folder / "live.rawlog").string()),
                      folder / "log.txt");
  for (int i = 0; i < 1000 && !isReceivedOn(left.lidar_port); ++i) std::this_thread::sleep_for(10ms);
  left.sensor->stream(left.datagrams, {});
  left.sensor->waitForStream();
  record.send(SIGINT);
  EXPECT_EQ(record.wait(), 130);
  const std::string log = record.log();
  EXPECT_THAT(log, HasSubstr("lidar 'right' joins when its sensor answers: sensor " + right.sensor->address()));
  const json report = json::parse(log.substr(log.find("\n{") + 1), nullptr, false);
  ASSERT_TRUE(report.is_object()) << log;
  EXPECT_GE(report["scans"].get<int>(), 29);
  EXPECT_GE(report["counts"]["left.blocks_emitted"].get<int>(), 29 * 512);
}

TEST(RecordFromSensors, aDryRunWritesToNoSensor)
{
  SCANLOOM_NEEDS_DATA(recording, "recordings/sparse");
  const FakeSensor sensor(contentOf(recording / "left.json"));
  const TemporaryFolder folder;
  std::ofstream(folder / "live.ini") << fmt::format(
      "[lidars]\ndriver = CMultiLidarSensor\nprocess_rate = 100\nlidar1_pose = [0 0 0 0 0 0]\nlidar1_address = {}\n"
      "lidar1_configure_sensor = true\n",
      sensor.address());
  ChildProcess record(fmt::format("{}/scanloom record -c {} -o {} --dry-run", SCANLOOM_BIN_DIR,
                                  (folder / "live.ini").string(), (folder / "live.rawlog").string()),
                      folder / "log.txt");
  EXPECT_EQ(record.wait(), 0) << record.log();
  for (const std::string& request : sensor.requests()) EXPECT_EQ(request.rfind("GET ", 0), 0u) << request;
}
}  // namespace scanloom::record_from_sensors_unittest
