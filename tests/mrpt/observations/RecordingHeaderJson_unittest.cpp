#include "mrpt/observations/RecordingHeaderJson.h"

#include "someScan.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace scanloom::recording_header_json_unittest
{
TEST(RecordingHeaderJson, comesBackFromItsJson)
{
  const RecordingHeader header = someHeader();
  const auto back = recordingHeaderFromJson(toJson(header));

  ASSERT_TRUE(back);
  EXPECT_EQ(back->scan_rate, 10);
  EXPECT_EQ(back->version, "0.1.0");
  ASSERT_EQ(back->lidars.size(), 2u);
  for (std::size_t i = 0; i < 2; i++)
  {
    EXPECT_EQ(back->lidars[i].name, header.lidars[i].name);
    EXPECT_EQ(back->lidars[i].serial, header.lidars[i].serial);
    EXPECT_EQ(back->lidars[i].model, header.lidars[i].model);
    EXPECT_EQ(back->lidars[i].beams, 128);
    EXPECT_EQ(back->lidars[i].columns, 1024);
    EXPECT_EQ(back->lidars[i].clock, header.lidars[i].clock);
    EXPECT_LT(boxMinus(back->lidars[i].body_T_sensor, header.lidars[i].body_T_sensor).norm(), 1e-12);
  }
}

TEST(RecordingHeaderJson, namesTheProgramsVersionWhereNoneIsGiven)
{
  EXPECT_FALSE(recordingHeaderFromJson(toJson(RecordingHeader{}))->version.empty());
}

TEST(RecordingHeaderJson, saysWhichSensorIdIsWhichLidar)
{
  const auto json = nlohmann::json::parse(toJson(someHeader()));
  EXPECT_EQ(json["scanloom"]["lidars"][1]["sensor_id"], 1);
  EXPECT_EQ(json["scanloom"]["lidars"][1]["name"], "right");
  EXPECT_NEAR(json["scanloom"]["lidars"][1]["body_T_sensor"][1][3].get<double>(), -1.2, 1e-12);
}

TEST(RecordingHeaderJson, isNotSeenInSomebodyElsesComment)
{
  EXPECT_FALSE(recordingHeaderFromJson("a walk in the woods"));
  EXPECT_FALSE(recordingHeaderFromJson(R"({"robot": 3})"));
  EXPECT_FALSE(recordingHeaderFromJson("[1, 2]"));
}

TEST(RecordingHeaderJson, namesTheKeyThatIsMissing)
{
  EXPECT_THAT(messageOf<std::invalid_argument>(
                  [&] { recordingHeaderFromJson(R"({"scanloom": {"version": "1", "lidars": []}})"); }),
              testing::HasSubstr("scan_rate"));
}

TEST(RecordingHeaderJson, refusesAPoseThatIsNoRotation)
{
  auto json = nlohmann::json::parse(toJson(someHeader()));
  json["scanloom"]["lidars"][0]["body_T_sensor"][0][0] = 7;
  EXPECT_THROW(recordingHeaderFromJson(json.dump()), std::invalid_argument);
}

TEST(RecordingHeaderJson, refusesWhatNoRigHasAndNamesIt)
{
  const auto refusalOf = [](const std::string& pointer, const nlohmann::json& value) -> std::string
  {
    auto json = nlohmann::json::parse(toJson(someHeader()));
    json["scanloom"][nlohmann::json::json_pointer(pointer)] = value;
    return messageOf<std::invalid_argument>([&] { recordingHeaderFromJson(json.dump()); });
  };
  EXPECT_EQ(refusalOf("/scan_rate", 20), "");
  for (const double rate : {1e-9, -1.0, 1e300})
    EXPECT_THAT(refusalOf("/scan_rate", rate), testing::HasSubstr("scan_rate")) << rate;
  EXPECT_THAT(refusalOf("/recorded_scan_rate", 1e-12), testing::HasSubstr("recorded_scan_rate"));
  EXPECT_THAT(refusalOf("/lidars/1/body_T_sensor/0/3", 1e30), testing::HasSubstr("'right'"));
  const nlohmann::json lidar = nlohmann::json::parse(toJson(someHeader()))["scanloom"]["lidars"][0];
  EXPECT_THAT(refusalOf("/lidars", std::vector<nlohmann::json>(257, lidar)), testing::HasSubstr("257 lidars"));
}
}  // namespace scanloom::recording_header_json_unittest
