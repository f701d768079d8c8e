/** packets/OusterHttp and packets/SensorHttp against the fake sensor: what a healthy one tells, and every fault. */
#include "input/packets/OusterHttp.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <future>
#include <thread>

#include "input/lidar/OusterMetadata.h"
#include "lab/simulation/internal/AssumedOuster.h"
#include "support/FakeSensor.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/with.h"

namespace scanloom::ouster_http_unittest
{
namespace
{
using Clock = std::chrono::steady_clock;

std::string someMetadata()
{
  return toJson(assumedOuster({"OS0-32", "512x10", "RNG15_RFL8_NIR8", "122000000001", 4711, 7502}));
}

SensorAddress addressOf(const FakeSensor& sensor) { return SensorAddress::parse(sensor.address()); }

/** What parseOusterMetadata makes of a text, as a text again: equal if every field is. */
std::string fieldsOf(const std::string& metadata) { return toJson(parseOusterMetadata(metadata, "metadata")); }

std::string metadataOf(const FakeSensor& sensor)
{
  SensorHttp http(addressOf(sensor), {});
  return fetchOusterMetadata(http);
}

struct Failure
{
  SensorFault fault;
  std::string message;
  double after;  // s
};

Failure failureOf(const SensorAddress& address, const SensorHttpLimits& limits = {})
{
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  try
  {
    SensorHttp http(address, limits);
    fetchOusterMetadata(http);
  }
  catch (const SensorHttpError& error)
  {
    return {error.fault, error.what(), elapsed()};
  }
  throw std::logic_error("metadata came from a sensor that should not have given any");
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
}  // namespace

TEST(OusterHttp, metadataOfASensorAreThoseOfItsFile)
{
  const FakeSensor sensor(someMetadata());
  EXPECT_EQ(fieldsOf(metadataOf(sensor)), fieldsOf(someMetadata()));
}

TEST(OusterHttp, metadataTellStatusAndTheConfigurationInUse)
{
  SCANLOOM_NEEDS_DATA(file, "ouster/ouster-lidar+ouster-sdk/tests/metadata/2_5_0_os-992146000760-128.json");
  const FakeSensor sensor(contentOf(file));
  const auto metadata = nlohmann::json::parse(metadataOf(sensor));
  EXPECT_EQ(metadata.at("sensor_info").at("status"), "RUNNING");
  EXPECT_EQ(metadata.at("config_params").at("udp_dest"), "10.0.0.167");
}

TEST(OusterHttp, readsEveryRealSensorFromFirmware20OnByNewAndOldEndpoints)
{
  SCANLOOM_NEEDS_DATA(folder, "ouster/ouster-lidar+ouster-sdk/tests");
  int read = 0, refused = 0;
  for (const char* part : {"metadata", "pcaps"})
    for (const auto& entry : std::filesystem::directory_iterator(folder / part))
    {
      const std::string text = entry.path().extension() == ".json" ? contentOf(entry.path()) : "";
      if (!contains(text, "image_rev")) continue;  // no sensor's own metadata: digests, reduced files
      for (const bool old : {false, true})
      {
        FakeSensor sensor(text, with(&FakeSensorOptions::old_endpoints, old));
        sensor.setStatus("RUNNING");  // two files were saved while the sensor started
        if (contains(text, "aries-v1."))
        {
          EXPECT_EQ(failureOf(addressOf(sensor)).fault, SensorFault::WrongFirmware) << entry.path();
          ++refused;
          continue;
        }
        EXPECT_EQ(fieldsOf(metadataOf(sensor)), fieldsOf(text)) << entry.path() << old;
        ++read;
      }
    }
  EXPECT_GE(read, 2 * 30);
  EXPECT_GE(refused, 2 * 8);
}

TEST(OusterHttp, configurationIsAskedForWhereTheMetadataHaveNone)
{
  const FakeSensor sensor(someMetadata(), with(&FakeSensorOptions::old_endpoints, true));
  EXPECT_EQ(parseOusterMetadata(metadataOf(sensor), "metadata").lidar_port, 7502);
  const auto requests = sensor.requests();
  EXPECT_EQ(std::count(requests.begin(), requests.end(), "GET /api/v1/sensor/cmd/get_config_param?args=active"), 1);
}

TEST(OusterHttp, askingNeverWritesToASensor)
{
  for (const bool old : {false, true})
  {
    const FakeSensor sensor(someMetadata(), with(&FakeSensorOptions::old_endpoints, old));
    const std::string before = sensor.metadata();
    metadataOf(sensor);
    EXPECT_EQ(sensor.metadata(), before);
    for (const std::string& request : sensor.requests())
      EXPECT_TRUE(contains(request, "GET ") && !contains(request, "set_") && !contains(request, "reinit")) << request;
  }
}

TEST(OusterHttp, setsTheDestinationOnceByNewAndOldEndpoints)
{
  const IpAddress here = IpAddress::parse("127.0.0.1");
  for (const bool old : {false, true})
  {
    const FakeSensor sensor(someMetadata(), with(&FakeSensorOptions::old_endpoints, old));
    SensorHttp http(addressOf(sensor), {});
    EXPECT_TRUE(setOusterDestination(http, here));
    const OusterMetadata after = parseOusterMetadata(sensor.metadata(), "metadata");
    EXPECT_EQ(after.init_id, 4712u);  // it started anew
    EXPECT_EQ(nlohmann::json::parse(sensor.metadata())["config_params"]["udp_dest"], "127.0.0.1");

    EXPECT_FALSE(setOusterDestination(http, here));
    EXPECT_EQ(parseOusterMetadata(sensor.metadata(), "metadata").init_id, 4712u);
  }
}

struct FaultCase
{
  FakeFault given;
  SensorFault seen;
  const char* said;
  double at_most;  // s
};
void PrintTo(const FaultCase& row, std::ostream* out) { *out << row.said; }

using SensorFaults = testing::TestWithParam<FaultCase>;

TEST_P(SensorFaults, areToldInTimeWithAddressEndpointAndCause)
{
  FakeSensor sensor(someMetadata());
  sensor.set(GetParam().given);
  const Failure failure = failureOf(addressOf(sensor));
  EXPECT_EQ(failure.fault, GetParam().seen) << failure.message;
  EXPECT_LE(failure.after, GetParam().at_most);
  EXPECT_TRUE(contains(failure.message, sensor.address())) << failure.message;
  EXPECT_TRUE(contains(failure.message, "GET /api/v1/")) << failure.message;
  EXPECT_TRUE(contains(failure.message, GetParam().said)) << failure.message;
}

TEST_P(SensorFaults, leaveASensorThatRecoversUsable)
{
  FakeSensor sensor(someMetadata());
  sensor.set(GetParam().given);
  failureOf(addressOf(sensor), {200ms, 1024 * 1024});
  sensor.set(FakeFault::None);
  EXPECT_EQ(fieldsOf(metadataOf(sensor)), fieldsOf(someMetadata()));
}

INSTANTIATE_TEST_SUITE_P(
    F21, SensorFaults,
    testing::Values(FaultCase{FakeFault::Silence, SensorFault::TimedOut, "within 2 s", 2.2},
                    FaultCase{FakeFault::Delay, SensorFault::TimedOut, "within 2 s", 2.2},
                    FaultCase{FakeFault::Trickle, SensorFault::TimedOut, "within 2 s", 2.2},
                    FaultCase{FakeFault::Disconnect, SensorFault::Interrupted, "connection ended", 0.5},
                    FaultCase{FakeFault::NotFound, SensorFault::Refused, "404", 0.5},
                    FaultCase{FakeFault::ServerError, SensorFault::Refused, "500", 0.5},
                    FaultCase{FakeFault::MalformedJson, SensorFault::Malformed, "no JSON object", 0.5},
                    FaultCase{FakeFault::PartialJson, SensorFault::Malformed, "no JSON object", 0.5},
                    FaultCase{FakeFault::ForeignJson, SensorFault::Malformed, "no Ouster sensor", 0.5},
                    FaultCase{FakeFault::HugeAnswer, SensorFault::TooLarge, "1048576 bytes", 1.0},
                    FaultCase{FakeFault::OldFirmware, SensorFault::WrongFirmware, "firmware 1.14.0", 0.5}));

TEST(OusterHttp, saysWhenNobodyListens)
{
  const std::string address = FakeSensor(someMetadata()).address();  // gone at once: the port is free
  const Failure failure = failureOf(SensorAddress::parse(address));
  EXPECT_EQ(failure.fault, SensorFault::Unreachable);
  EXPECT_LE(failure.after, 0.5);
}

TEST(OusterHttp, anAddressThatSwallowsPacketsTakesNoLongerThanTheLimit)
{
  const Failure failure = failureOf(SensorAddress::parse("192.0.2.1"), {500ms, 1024});  // RFC 5737: nobody's
  EXPECT_TRUE(failure.fault == SensorFault::TimedOut || failure.fault == SensorFault::Unreachable) << failure.message;
  EXPECT_LE(failure.after, 0.7);
}

TEST(OusterHttp, aSensorThatStartsIsRefusedUntilItRuns)
{
  FakeSensor sensor(someMetadata(), with(&FakeSensorOptions::initialising, 300ms));
  sensor.restart(4712);
  const Failure failure = failureOf(addressOf(sensor));
  EXPECT_EQ(failure.fault, SensorFault::NotRunning);
  EXPECT_TRUE(contains(failure.message, "INITIALIZING")) << failure.message;

  std::this_thread::sleep_for(350ms);
  EXPECT_EQ(parseOusterMetadata(metadataOf(sensor), "metadata").init_id, 4712u);
}

TEST(OusterHttp, aSensorOnStandbySaysHowToWakeIt)
{
  FakeSensor sensor(someMetadata());
  sensor.setStatus("STANDBY");
  EXPECT_TRUE(contains(failureOf(addressOf(sensor)).message, "operating_mode to NORMAL"));
}

TEST(OusterHttp, metadataThatTheParserRefusesNameTheKey)
{
  nlohmann::json wrong = nlohmann::json::parse(someMetadata());
  wrong["beam_intrinsics"].erase("beam_azimuth_angles");
  const FakeSensor sensor(wrong.dump());
  const Failure failure = failureOf(addressOf(sensor));
  EXPECT_EQ(failure.fault, SensorFault::Malformed);
  EXPECT_TRUE(contains(failure.message, "beam_azimuth_angles")) << failure.message;
}

TEST(SensorHttp, cancelEndsARequestThatHangs)
{
  FakeSensor sensor(someMetadata());
  sensor.set(FakeFault::Silence);
  SensorHttp http(addressOf(sensor), {60s, 1024});
  auto asked =
      std::async(std::launch::async, [&] { EXPECT_THROW(http.get("/api/v1/system/firmware"), SensorHttpError); });
  std::this_thread::sleep_for(100ms);
  const auto start = Clock::now();
  http.cancel();
  asked.wait();
  EXPECT_LE(Clock::now() - start, 500ms);
}
}  // namespace scanloom::ouster_http_unittest
