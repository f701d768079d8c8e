/** A rig that is configured by the sensors' addresses only: rig/Rig, RigSensor, LidarMetadata, SensorInquiries. */
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

#include "input/lidar/OusterMetadata.h"
#include "input/rig/Rig.h"
#include "input/rig/internal/SensorInquiries.h"
#include "lab/simulation/internal/AssumedOuster.h"
#include "support/FakeSensor.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/with.h"

namespace scanloom::rig_from_sensors_unittest
{
namespace
{
using Clock = std::chrono::steady_clock;

std::string someMetadata(std::uint16_t port = 7502)
{
  return toJson(assumedOuster({"OS0-32", "512x10", "RNG15_RFL8_NIR8", "122000000001", 4711, port}));
}

std::string lidarIni(int number, const std::string& key, const std::string& value, const std::string& more = "")
{
  return fmt::format("lidar{0}_name = {1}\nlidar{0}_{2} = {3}\nlidar{0}_pose = [0 0 0 0 0 0]\n{4}", number,
                     std::string(1, static_cast<char>('a' + number - 1)), key, value, more);
}

RigSettings settingsOf(const std::string& lidars)
{
  const Configuration configuration =
      Configuration::fromText("[rig]\ndriver = CMultiLidarSensor\nprocess_rate = 100\n" + lidars, "x.ini");
  return readRigSettings(configuration, "rig");
}

double secondsOf(const std::function<void()>& action)
{
  const auto start = Clock::now();
  action();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string fieldsOf(const RigSensor& lidar)
{
  return toJson(parseOusterMetadata(lidar.metadata->text, lidar.metadata->name));
}

bool writes(const FakeSensor& sensor)
{
  const auto requests = sensor.requests();
  return std::any_of(requests.begin(), requests.end(), [](const auto& r) { return r.rfind("POST", 0) == 0; });
}

SensorAddress addressOf(const FakeSensor& sensor) { return SensorAddress::parse(sensor.address()); }

/** Polls the inquiries until one answers, or 5 s have passed. */
std::vector<SensorInquiries::Answer> waitForAnswer(SensorInquiries& inquiries)
{
  for (int i = 0; i < 500; ++i)
  {
    auto answers = inquiries.take();
    if (!answers.empty()) return answers;
    std::this_thread::sleep_for(10ms);
  }
  return {};
}
}  // namespace

TEST(RigFromSensors, knowsTheSameAsARigFromFiles)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const FakeSensor left(contentOf(folder / "left.json"), {"127.0.0.2"});
  const FakeSensor right(contentOf(folder / "right.json"), {"127.0.0.3"});
  const Rig asked =
      makeRig(settingsOf(lidarIni(1, "address", left.address()) + lidarIni(2, "address", right.address())));
  const Rig read = makeRig(settingsOf(lidarIni(1, "metadata", (folder / "left.json").string()) +
                                      lidarIni(2, "metadata", (folder / "right.json").string())));
  for (std::size_t i : {0, 1})
  {
    EXPECT_EQ(fieldsOf(asked.sensors[i]), fieldsOf(read.sensors[i]));
    EXPECT_EQ(asked.addresses[i].lidar_port, read.addresses[i].lidar_port);
    EXPECT_EQ(asked.addresses[i].imu_port, read.addresses[i].imu_port);
    EXPECT_NE(asked.lidars[i].decoder, nullptr);
  }
  EXPECT_EQ(asked.addresses[1].source, IpAddress::parse("127.0.0.3"));
  EXPECT_FALSE(writes(left) || writes(right));
}

TEST(RigFromSensors, startsWithin2SecondsWithoutThoseThatAreSilentOrStart)
{
  FakeSensor good(someMetadata()), silent(someMetadata()), late(someMetadata()),
      starting(someMetadata(), with(&FakeSensorOptions::initialising, 1h));
  silent.set(FakeFault::Silence);
  late.set(FakeFault::Delay);
  starting.restart(4712);
  Rig rig;
  const double took = secondsOf(
      [&]
      {
        rig = makeRig(settingsOf(lidarIni(1, "address", silent.address()) + lidarIni(2, "address", good.address()) +
                                 lidarIni(3, "address", late.address()) + lidarIni(4, "address", starting.address())));
      });
  EXPECT_LE(took, 2.0);
  ASSERT_EQ(rig.lidars.size(), 4u);
  EXPECT_NE(rig.lidars[1].decoder, nullptr);
  for (std::size_t i : {0, 2, 3})
  {
    EXPECT_EQ(rig.lidars[i].decoder, nullptr);
    EXPECT_NE(rig.sensors[i].failure.find(rig.sensors[i].options.address), std::string::npos);
    EXPECT_EQ(rig.addresses[i].lidar_port, 7502);
  }
}

TEST(RigFromSensors, doesNotBeginWhereNoSensorIsOrWillBeThere)
{
  FakeSensor broken(someMetadata());
  broken.set(FakeFault::NotFound);
  const std::string lidar = lidarIni(1, "address", broken.address());
  EXPECT_THROW(makeRig(settingsOf(lidar)), ConfigError);
  broken.set(FakeFault::None);
  broken.setStatus("INITIALIZING");
  EXPECT_NO_THROW(makeRig(settingsOf(lidar)));
}

TEST(RigFromSensors, aCaptureNeedsTheMetadataOfAll)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  FakeSensor good(someMetadata()), broken(someMetadata());
  broken.set(FakeFault::PartialJson);
  EXPECT_THROW(makeRig(settingsOf(lidarIni(1, "address", good.address()) + lidarIni(2, "address", broken.address()) +
                                  "pcap_input = " + (folder / "recording.pcap").string() + "\n")),
               ConfigError);
}

TEST(RigFromSensors, theConfigurationIsHeardBeforeTheMetadata)
{
  const FakeSensor sensor(someMetadata());
  const Rig rig = makeRig(settingsOf(lidarIni(1, "address", sensor.address(), "lidar1_port = 9000\n")));
  EXPECT_EQ(rig.addresses[0].lidar_port, 9000);
}

TEST(RigFromSensors, aLidarNeedsMetadataOrAnAddress)
{
  EXPECT_THROW(settingsOf(""), ConfigError);
  EXPECT_THROW(settingsOf("lidar1_metadata =\n"), ConfigError);
  EXPECT_THROW(makeRig(settingsOf(lidarIni(1, "address", "os-122.local"))), ConfigError);
}

TEST(RigFromSensors, writesToNoSensorBeforeItIsLive)
{
  const FakeSensor sensor(someMetadata());
  const Rig rig = makeRig(settingsOf(lidarIni(1, "address", sensor.address(), "lidar1_configure_sensor = true\n")));
  EXPECT_FALSE(writes(sensor));
  EXPECT_TRUE(rig.sensors[0].sensor->configure);
}

TEST(SensorInquiries, configureASensorOnceAndAskItWhenItHasStartedAnew)
{
  const FakeSensor sensor(someMetadata(), with(&FakeSensorOptions::initialising, 300ms));
  SensorInquiries inquiries;
  inquiries.ask(0, {addressOf(sensor), true});
  const auto answers = waitForAnswer(inquiries);
  ASSERT_EQ(answers.size(), 1u);
  const auto config = nlohmann::json::parse(answers[0].metadata.text)["config_params"];
  EXPECT_EQ(config["udp_dest"], "127.0.0.1");
  const auto requests = sensor.requests();
  EXPECT_EQ(std::count(requests.begin(), requests.end(), "POST /api/v1/sensor/config?reinit=true&persist=false"), 1);
}

TEST(SensorInquiries, askUntilTheSensorAnswersAndTellAFailureOnce)
{
  FakeSensor sensor(someMetadata());
  sensor.set(FakeFault::ServerError);
  SensorInquiries inquiries;
  inquiries.ask(3, {addressOf(sensor), false});
  inquiries.ask(3, {addressOf(sensor), false});
  std::this_thread::sleep_for(900ms);  // attempts at 0, 0.25 and 0.75 s
  EXPECT_GE(sensor.requests().size(), 3u);
  EXPECT_LE(sensor.requests().size(), 4u);
  EXPECT_EQ(inquiries.takeFailures().size(), 1u);

  sensor.set(FakeFault::None);
  const auto answers = waitForAnswer(inquiries);
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].lidar, 3u);
  EXPECT_TRUE(inquiries.takeFailures().empty());

  sensor.restart(4712);
  inquiries.ask(3, {addressOf(sensor), false});
  const auto again = waitForAnswer(inquiries);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(parseOusterMetadata(again[0].metadata.text, "").init_id, 4712u);
}

TEST(SensorInquiries, endAtOnceHoweverSilentTheSensors)
{
  FakeSensor sensor(someMetadata());
  sensor.set(FakeFault::Silence);
  auto inquiries = std::make_unique<SensorInquiries>();
  for (std::size_t i = 0; i < 4; ++i) inquiries->ask(i, {addressOf(sensor), false});
  std::this_thread::sleep_for(100ms);
  EXPECT_LE(secondsOf([&] { inquiries.reset(); }), 0.5);
}
}  // namespace scanloom::rig_from_sensors_unittest
