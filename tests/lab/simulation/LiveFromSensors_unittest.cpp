/** Live lidars of which only the addresses are known: fake sensors that answer, send, fail and change (F11, F21). */
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <thread>

#include "input/lidar/OusterEncoder.h"
#include "input/lidar/OusterMetadata.h"
#include "input/rig/internal/RigLive.h"
#include "input/rig/internal/RigReplay.h"
#include "lab/simulation/internal/AssumedOuster.h"
#include "support/FakeSensor.h"
#include "support/TemporaryFolder.h"
#include "support/UdpSender.h"
#include "support/with.h"

namespace scanloom::live_from_sensors_unittest
{
namespace
{
using Clock = std::chrono::steady_clock;

constexpr Timestamp kEpoch{1000s};

std::string metadataOf(const std::string& serial, std::uint16_t port, const std::string& mode = "512x10",
                       std::uint32_t init_id = 1)
{
  return toJson(assumedOuster({"OS0-32", mode, "RNG15_RFL8_NIR8", serial, init_id, port}));
}

/** What the sensor sends in [first, first + length); every channel measures 5 m. */
std::vector<Datagram> packetsOf(const std::string& metadata, Timestamp first, Duration length)
{
  const OusterEncoder encoder(parseOusterMetadata(metadata, "metadata"));
  const OusterMetadata& m = encoder.metadata();
  const Duration block = fromSeconds(1 / (m.frame_rate * m.columns_per_frame));
  const std::vector<OusterReading> readings(static_cast<std::size_t>(m.channels),
                                            OusterReading{{5000, 50, 100}, {}, 10});
  std::vector<Datagram> datagrams;
  std::vector<OusterColumn> columns;
  for (std::int64_t i = 0; i * block < length; ++i)
  {
    columns.push_back({first + i * block, static_cast<std::uint32_t>(i / m.columns_per_frame),
                       static_cast<std::uint16_t>(i % m.columns_per_frame), true, readings});
    if (columns.size() < static_cast<std::size_t>(m.columns_per_packet)) continue;
    datagrams.push_back({columns.back().stamp + block, {}, 0, m.lidar_port, encoder.lidarPacket(columns)});
    columns.clear();
  }
  return datagrams;
}

/**
 * Sensors a and b at 127.0.0.2 and 127.0.0.3, a rig that knows no more than that, and what comes of it. The deadline
 * is long, as the sensors of a busy test machine are late.
 */
class TwoSensors : public testing::Test
{
 protected:
  TwoSensors() : a_(metadata_a_, {"127.0.0.2"}), b_(metadata_b_, {"127.0.0.3"}) {}

  Rig rig(const std::string& more = "") const
  {
    const Configuration configuration = Configuration::fromText(
        fmt::format("[rig]\ndriver = CMultiLidarSensor\nprocess_rate = 100\ndeadline_ms = 200\n"
                    "lidar1_name = a\nlidar1_address = {}\nlidar1_pose = [0 0 0 0 0 0]\nlidar1_port = {}\n"
                    "lidar2_name = b\nlidar2_address = {}\nlidar2_pose = [1 0 0 0 0 0]\nlidar2_port = {}\n{}",
                    a_.address(), port_a_, b_.address(), port_b_, more),
        "x.ini");
    return makeRig(readRigSettings(configuration, "rig"));
  }

  StreamOptions together() const { return with(&StreamOptions::start, start_, with(&StreamOptions::origin, kEpoch)); }

  /** Until both have sent all; what waits is taken meanwhile, as a recorder does. */
  std::vector<Scan> readAll(RigLive& live)
  {
    auto reading = std::async(std::launch::async,
                              [&]
                              {
                                std::vector<Scan> scans;
                                while (auto event = live.next())
                                  if (auto* scan = std::get_if<Scan>(&*event)) scans.push_back(std::move(*scan));
                                return scans;
                              });
    meanwhile_();
    a_.waitForStream();
    b_.waitForStream();
    live.stop();
    return reading.get();
  }

  std::function<void()> meanwhile_ = [] {};

  const std::uint16_t port_a_ = freeUdpPort(), port_b_ = freeUdpPort();
  const std::string metadata_a_ = metadataOf("122000000001", port_a_),
                    metadata_b_ = metadataOf("122000000002", port_b_);
  FakeSensor a_, b_;
  const Clock::time_point start_ = Clock::now() + 2s;
};

/** The first column of a sensor, and how many there are. */
struct Columns
{
  std::optional<Timestamp> first;
  std::size_t count = 0;
};

Columns columnsOf(const std::vector<Scan>& scans, std::uint8_t sensor, std::uint16_t at_least_id = 0)
{
  Columns columns;
  for (const Scan& scan : scans)
    for (const Column& column : scan.columns)
    {
      if (column.sensor_id != sensor || column.measurement_id < at_least_id) continue;
      if (!columns.first) columns.first = column.stamp;
      ++columns.count;
    }
  return columns;
}

std::vector<std::string> writesTo(const FakeSensor& sensor)
{
  std::vector<std::string> requests = sensor.requests();
  const auto asks = [](const std::string& request) { return request.rfind("GET ", 0) == 0; };
  requests.erase(std::remove_if(requests.begin(), requests.end(), asks), requests.end());
  return requests;
}

std::string joined(const std::vector<std::string>& lines)
{
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}
}  // namespace

TEST_F(TwoSensors, giveTheirScansToARigThatKnowsOnlyTheirAddresses)
{
  RigLive live(rig());
  a_.stream(packetsOf(metadata_a_, kEpoch, 1s), together());
  b_.stream(packetsOf(metadata_b_, kEpoch, 1s), together());
  const auto scans = readAll(live);
  for (const LidarAccount& lidar : live.account().lidars)
  {
    EXPECT_EQ(lidar.counters.received, 10u * 512);
    EXPECT_EQ(lidar.counters.emitted + lidar.counters.before_start, 10u * 512);
  }
  EXPECT_GE(scans.size(), 9u);
}

TEST_F(TwoSensors, leaveACaptureThatItsOwnMetadataFilesMakeReadable)
{
  const TemporaryFolder folder;
  const std::filesystem::path capture = folder / "x.pcap";
  std::vector<Scan> scans;
  {
    RigLive live(rig("pcap_output = " + capture.string() + "\n"));
    a_.stream(packetsOf(metadata_a_, kEpoch, 500ms), together());
    b_.stream(packetsOf(metadata_b_, kEpoch, 500ms), together());
    scans = readAll(live);
  }
  const Configuration configuration = Configuration::fromText(
      fmt::format("[rig]\ndriver = CMultiLidarSensor\nprocess_rate = 100\npcap_input = {}\ndeadline_ms = 200\n"
                  "lidar1_name = a\nlidar1_metadata = {}\nlidar1_pose = [0 0 0 0 0 0]\nlidar1_port = {}\n"
                  "lidar2_name = b\nlidar2_metadata = {}\nlidar2_pose = [1 0 0 0 0 0]\nlidar2_port = {}\n",
                  capture.string(), (folder / "x.a.json").string(), port_a_, (folder / "x.b.json").string(), port_b_),
      "x.ini");
  RigReplay replay(makeRig(readRigSettings(configuration, "rig")));
  std::size_t next = 0;
  while (auto event = replay.next())
  {
    const auto* scan = std::get_if<Scan>(&*event);
    if (!scan) continue;
    ASSERT_LT(next, scans.size());
    EXPECT_EQ(scan->start, scans[next].start);
    EXPECT_EQ(scan->points.x, scans[next].points.x);
    EXPECT_EQ(scan->points.t, scans[next].points.t);
    ++next;
  }
  EXPECT_GE(next, 4u);
  EXPECT_EQ(next, scans.size());
}

/** F21: whatever its web interface does, the sensor joins soon after it answers, and the other one lacks nothing. */
class LateSensor : public TwoSensors, public testing::WithParamInterface<FakeFault>
{
};

TEST_P(LateSensor, joinsWhenItAnswersAndTheOtherOneLacksNothing)
{
  b_.set(GetParam());
  const auto asked = Clock::now();
  RigLive live(rig());
  EXPECT_LE(Clock::now() - asked, 2s);
  a_.stream(packetsOf(metadata_a_, kEpoch, 5s), together());
  b_.stream(packetsOf(metadata_b_, kEpoch, 5s), together());
  meanwhile_ = [&]
  {
    std::this_thread::sleep_until(start_ + 1s);
    b_.set(FakeFault::None);
  };
  const auto scans = readAll(live);

  const std::string told = joined(live.takeWarnings());
  EXPECT_NE(told.find("lidar 'b' joins when its sensor answers"), std::string::npos) << told;
  EXPECT_NE(told.find("known now"), std::string::npos) << told;

  const Columns a = columnsOf(scans, 0), b = columnsOf(scans, 1);
  EXPECT_EQ(a.count + live.account().lidars[0].counters.before_start, 50u * 512);
  ASSERT_TRUE(b.first) << told;
  const double joined_after = seconds(*b.first - (kEpoch + 1s));
  RecordProperty("joined_after_s", std::to_string(joined_after));
  EXPECT_GT(joined_after, 0);
  EXPECT_LE(joined_after, 2.5) << "the longest pause, one answer, and a scan";
  EXPECT_TRUE(scans[3].missing.test(1) || scans[3].columns_of[1] == 0);
  EXPECT_GE(scans.size(), 49u);
}
INSTANTIATE_TEST_SUITE_P(F21, LateSensor,
                         testing::Values(FakeFault::Silence, FakeFault::Delay, FakeFault::NotFound,
                                         FakeFault::MalformedJson, FakeFault::PartialJson, FakeFault::OldFirmware));

TEST_F(TwoSensors, oneThatIsConfiguredAnewIsReadByItsNewMetadataWithin3Seconds)  // F11
{
  RigLive live(rig());
  const std::string anew = metadataOf("122000000002", port_b_, "1024x20", 2);
  a_.stream(packetsOf(metadata_a_, kEpoch, 6s), together());
  b_.stream(packetsOf(metadata_b_, kEpoch, 2s), together());
  meanwhile_ = [&]
  {
    b_.waitForStream();
    b_.restart(2, anew);
    b_.stream(packetsOf(anew, kEpoch + 3s, 3s), together());
  };
  const auto scans = readAll(live);

  const std::string told = joined(live.takeWarnings());
  EXPECT_NE(told.find("configured differently"), std::string::npos) << told;
  const Columns anew_read = columnsOf(scans, 1, 512);  // ids that only the new mode has
  ASSERT_TRUE(anew_read.first) << told;
  const double after = seconds(*anew_read.first - (kEpoch + 3s));
  RecordProperty("read_again_after_s", std::to_string(after));
  EXPECT_LE(after, 3.0);
  EXPECT_EQ(columnsOf(scans, 0).count + live.account().lidars[0].counters.before_start, 60u * 512);
}

TEST_F(TwoSensors, anotherStartAloneKeepsTheDecoder)
{
  RigLive live(rig());
  const std::string again = metadataOf("122000000002", port_b_, "512x10", 2);
  a_.stream(packetsOf(metadata_a_, kEpoch, 4s), together());
  b_.stream(packetsOf(metadata_b_, kEpoch, 1s), together());
  meanwhile_ = [&]
  {
    b_.waitForStream();
    b_.restart(2);
    b_.stream(packetsOf(again, kEpoch + 2s, 2s), together());
  };
  readAll(live);
  const std::string told = joined(live.takeWarnings());
  EXPECT_EQ(told.find("configured differently"), std::string::npos) << told;
  const auto requests = b_.requests();
  EXPECT_EQ(std::count(requests.begin(), requests.end(), "GET /api/v1/sensor/metadata"), 2) << told;
}

TEST_F(TwoSensors, oneThatSendsToAPortNobodyListensAtIsNamed)
{
  b_.set(FakeFault::NotFound);
  Rig half_known = rig();
  half_known.sensors[1].options.port = 0;  // its metadata say where it sends
  half_known.addresses[1].lidar_port = freeUdpPort();
  RigLive live(half_known);
  b_.set(FakeFault::None);
  std::string told;
  for (int i = 0; i < 40 && told.find("nobody listens") == std::string::npos; ++i)
  {
    std::this_thread::sleep_for(100ms);
    told += joined(live.takeWarnings());
  }
  EXPECT_NE(told.find(fmt::format("UDP port {}, where nobody listens", port_b_)), std::string::npos) << told;
}

TEST_F(TwoSensors, areToldToSendHereIfTheyMayBeConfigured)
{
  const Rig with_wish = rig("lidar2_configure_sensor = true\n");
  EXPECT_TRUE(writesTo(b_).empty());
  {
    RigLive live(with_wish);
    for (int i = 0; i < 300 && writesTo(b_).empty(); ++i) std::this_thread::sleep_for(10ms);
    std::this_thread::sleep_for(600ms);  // nor is it told again
  }
  EXPECT_EQ(writesTo(b_).size(), 1u);
  EXPECT_TRUE(writesTo(a_).empty());
}
}  // namespace scanloom::live_from_sensors_unittest
