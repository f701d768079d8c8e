#include "input/lidar/OusterMetadata.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "captures.h"

namespace scanloom::ouster_metadata_unittest
{
using testing::HasSubstr;

namespace
{
nlohmann::json reduced()
{
  return {{"lidar_mode", "1024x10"}, {"beam_altitude_angles", {10, 0, -10}}, {"beam_azimuth_angles", {1, -1, 1}}};
}

nlohmann::json nested()
{
  nlohmann::json json;
  json["sensor_info"] = {{"prod_line", "OS-0-128"}, {"prod_sn", "122247000785"}, {"initialization_id", 5}};
  json["config_params"] = {{"lidar_mode", "512x20"}, {"udp_port_lidar", 7602}};
  json["lidar_data_format"] = {{"pixels_per_column", 3},
                               {"columns_per_packet", 16},
                               {"columns_per_frame", 512},
                               {"udp_profile_lidar", "RNG15_RFL8_NIR8"},
                               {"column_window", {370, 85}}};
  json["beam_intrinsics"] = {{"beam_altitude_angles", {10, 0, -10}}, {"beam_azimuth_angles", {1, -1, 1}}};
  return json;
}

std::string complaintAbout(const nlohmann::json& json)
{
  try
  {
    parseOusterMetadata(json.dump(), "left.json");
  }
  catch (const std::invalid_argument& e)
  {
    return e.what();
  }
  return "nothing";
}
}  // namespace

class MetadataOf : public testing::TestWithParam<std::string>
{
};

TEST_P(MetadataOf, everyFirmwareIsReadAndWrittenBackWithoutLoss)
{
  SCANLOOM_NEEDS_DATA(folder, kOusterTests + GetParam());
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".json" || name.find("digest") != std::string::npos) continue;
    SCOPED_TRACE(name);
    ++files;
    const OusterMetadata m = loadOusterMetadata(entry.path().string());
    EXPECT_EQ(static_cast<std::size_t>(m.channels), m.beam_altitude_deg.size());
    EXPECT_NEAR(m.lidar_to_sensor_mm(2, 3), 57, 22);
    EXPECT_EQ(toJson(parseOusterMetadata(toJson(m), "written back")), toJson(m));
  }
  RecordProperty("files", files);
  EXPECT_GE(files, 19);
}
INSTANTIATE_TEST_SUITE_P(Folders, MetadataOf, testing::Values("metadata", "pcaps"),
                         [](const auto& p) { return p.param; });

TEST(OusterMetadata, bringsNothingThatATerminalObeys)
{
  nlohmann::json json = nested();
  json["sensor_info"]["prod_line"] = "OS-0\x1b[2J-128";
  EXPECT_EQ(parseOusterMetadata(json.dump(), "left.json").product_line, "OS-0?[2J-128");
  json["lidar_data_format"]["udp_profile_lidar"] = "\x1b]0;owned\x07";
  EXPECT_THAT(complaintAbout(json), HasSubstr("'?]0;owned?' is unknown"));
}

TEST(OusterMetadata, theFlatAndTheNestedFileOfOneSensorSayTheSame)
{
  for (const std::string name : {"2_1_2_os1-991913000010-64", "2_2_os-992119000444-128", "2_3_1_os-992146000760-128",
                                 "2_4_0_os-992146000760-128", "2_5_0_os-992146000760-128", "3_0_1_os-122246000293-128"})
  {
    SCANLOOM_NEEDS_DATA(folder, kOusterTests + "metadata");
    SCOPED_TRACE(name);
    OusterMetadata nested_file = loadOusterMetadata((folder / (name + ".json")).string());
    OusterMetadata flat_file = loadOusterMetadata((folder / (name + "_legacy.json")).string());
    nested_file.timestamp_mode.clear();  // what flat files do not say
    nested_file.lidar_port = flat_file.lidar_port = 0;
    nested_file.imu_port = flat_file.imu_port = 0;
    EXPECT_EQ(toJson(nested_file), toJson(flat_file));
  }
}

TEST(OusterMetadata, aReducedFileGetsTheDefaultsOfTheFirstGeneration)
{
  const OusterMetadata m = parseOusterMetadata(reduced().dump(), "reduced.json");
  EXPECT_EQ(m.lidar_profile, "LEGACY");
  EXPECT_EQ(m.columns_per_packet, 16);
  EXPECT_EQ(m.columns_per_frame, 1024);
  EXPECT_EQ(m.frame_rate, 10);
  EXPECT_EQ(m.first_column, 0);
  EXPECT_EQ(m.last_column, 1023);
  EXPECT_EQ(m.channels, 3);
  EXPECT_EQ(m.beam_to_lidar_mm(0, 3), 12.163);
  EXPECT_EQ(m.lidar_to_sensor_mm(0, 0), -1);
  EXPECT_EQ(m.lidar_to_sensor_mm(2, 3), 36.18);
  EXPECT_EQ(m.imu_to_sensor_mm(1, 3), -11.775);
  EXPECT_FALSE(m.init_id);
  EXPECT_FALSE(serialNumber(m));
}

TEST(OusterMetadata, aMissingBeamOriginComesFromTheProductLine)
{
  for (const auto& [line, origin] : {std::pair{"OS-0-32-U0", 27.67}, {"OS-1-64", 15.806}, {"OS-2-128", 13.762}})
  {
    nlohmann::json json = reduced();
    json["prod_line"] = line;
    EXPECT_EQ(parseOusterMetadata(json.dump(), "x").beam_to_lidar_mm(0, 3), origin) << line;
  }
}

TEST(OusterMetadata, theNestedLayoutIsRead)
{
  const OusterMetadata m = parseOusterMetadata(nested().dump(), "x");
  EXPECT_EQ(m.lidar_profile, "RNG15_RFL8_NIR8");
  EXPECT_EQ(m.first_column, 370);
  EXPECT_EQ(m.last_column, 85);
  EXPECT_EQ(m.frame_rate, 20);
  EXPECT_EQ(m.lidar_port, 7602);
  EXPECT_EQ(m.init_id, 5u);
  EXPECT_EQ(serialNumber(m), 122247000785u);
}

TEST(OusterMetadata, theUsersExtrinsicsAreNotUsed)
{
  nlohmann::json json = nested();
  json["ouster-sdk"]["extrinsic"] = {1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1};
  EXPECT_EQ(toJson(parseOusterMetadata(json.dump(), "x")), toJson(parseOusterMetadata(nested().dump(), "x")));
}

TEST(OusterMetadata, theHeaderTypeFollowsTheFusaProfileOfOldFirmware)
{
  nlohmann::json json = nested();
  json["lidar_data_format"]["udp_profile_lidar"] = "FUSA_RNG15_RFL8_NIR8_DUAL";
  EXPECT_EQ(layoutOf(parseOusterMetadata(json.dump(), "x")).lidar_header, OusterHeader::Fusa);
  json["lidar_data_format"]["udp_profile_lidar"] = "RNG15_RFL8_NIR8_DUAL";
  EXPECT_EQ(layoutOf(parseOusterMetadata(json.dump(), "x")).lidar_header, OusterHeader::Standard);
  json["lidar_data_format"]["header_type"] = "FUSA";
  EXPECT_EQ(layoutOf(parseOusterMetadata(json.dump(), "x")).lidar_header, OusterHeader::Fusa);
}

struct Mistake
{
  std::string what;
  nlohmann::json patch;
  std::string complaint;
};
void PrintTo(const Mistake& m, std::ostream* out) { *out << m.what; }

class MistakeInMetadata : public testing::TestWithParam<Mistake>
{
};

TEST_P(MistakeInMetadata, isNamedWithFileKeyAndWhatIsExpected)
{
  nlohmann::json json = nested();
  json.merge_patch(GetParam().patch);
  const std::string complaint = complaintAbout(json);
  EXPECT_THAT(complaint, HasSubstr("left.json: "));
  EXPECT_THAT(complaint, HasSubstr(GetParam().complaint));
}

INSTANTIATE_TEST_SUITE_P(
    Keys, MistakeInMetadata,
    testing::Values(
        Mistake{"noMode", {{"config_params", {{"lidar_mode", nullptr}}}}, "lidar_mode: is missing"},
        Mistake{"badMode", {{"config_params", {{"lidar_mode", "1024"}}}}, "lidar_mode: must be columns x turns"},
        Mistake{"otherMode", {{"config_params", {{"lidar_mode", "1024x10"}}}}, "columns_per_frame: 512 contradicts"},
        Mistake{"noAngles", {{"beam_intrinsics", nullptr}}, "beam_altitude_angles: is missing"},
        Mistake{"fewAngles",
                {{"beam_intrinsics", {{"beam_azimuth_angles", {1, 2}}}}},
                "beam_azimuth_angles: must have one number per channel (3), not 2"},
        Mistake{"noAngle",
                {{"beam_intrinsics", {{"beam_azimuth_angles", {1, "a", 2}}}}},
                "beam_azimuth_angles: element 1 must be a number from -360 to 360"},
        Mistake{"steepAngle", {{"beam_intrinsics", {{"beam_altitude_angles", {1, 91, 2}}}}}, "from -90 to 90, not 91"},
        Mistake{"solidState", {{"beam_intrinsics", {{"beam_altitude_angles", {{1, 2}, {3, 4}}}}}}, "solid-state"},
        Mistake{"profile",
                {{"lidar_data_format", {{"udp_profile_lidar", "RNG99"}}}},
                "udp_profile_lidar: 'RNG99' is unknown; known are LEGACY, RNG19_RFL8_SIG16_NIR16,"},
        Mistake{
            "imuProfile", {{"lidar_data_format", {{"udp_profile_imu", "X"}}}}, "known are LEGACY, ACCEL32_GYRO32_NMEA"},
        Mistake{"imuCount",
                {{"lidar_data_format", {{"udp_profile_imu", "ACCEL32_GYRO32_NMEA"}}}},
                "imu_measurements_per_packet: is missing"},
        Mistake{"window", {{"lidar_data_format", {{"column_window", {0, 512}}}}}, "column_window: element 1 must be"},
        Mistake{"windowLength", {{"lidar_data_format", {{"column_window", {0}}}}}, "must be [first, last], not 1"},
        Mistake{"channels", {{"lidar_data_format", {{"pixels_per_column", 64}}}}, "per channel (64), not 3"},
        Mistake{"noPacket",
                {{"lidar_data_format", {{"columns_per_packet", 0}}}},
                "columns_per_packet: must be a whole number"},
        Mistake{"halfPacket", {{"lidar_data_format", {{"columns_per_packet", 1.5}}}}, "not 1.5"},
        Mistake{"initId", {{"sensor_info", {{"initialization_id", -1}}}}, "initialization_id: must be a whole number"},
        Mistake{"serialType", {{"sensor_info", {{"prod_sn", 12}}}}, "prod_sn: must be a text in quotes, not 12"},
        Mistake{
            "matrixLength", {{"lidar_intrinsics", {{"lidar_to_sensor_transform", {1, 2}}}}}, "must have 16 numbers"},
        Mistake{"matrix",
                {{"lidar_intrinsics", {{"lidar_to_sensor_transform", std::vector<int>(16, 1)}}}},
                "lidar_to_sensor_transform: must be a rigid transform"}),
    [](const auto& p) { return p.param.what; });

TEST(OusterMetadata, aTextThatIsNoJsonIsNamedWithItsFile)
{
  for (const std::string text : {"", "{", "[1, 2]", "1", "\xff\xfe", "{\"lidar_mode\": 1e999}"})
  {
    SCOPED_TRACE(text);
    try
    {
      parseOusterMetadata(text, "left.json");
      FAIL() << "accepted";
    }
    catch (const std::invalid_argument& e)
    {
      EXPECT_THAT(e.what(), HasSubstr("left.json: not a metadata file"));
    }
  }
}

TEST(OusterMetadata, packetsLargerThanADatagramAreRefused)
{
  nlohmann::json json = nested();
  json["lidar_data_format"]["pixels_per_column"] = 256;
  json["lidar_data_format"]["columns_per_packet"] = 128;
  json["beam_intrinsics"]["beam_altitude_angles"] = std::vector<int>(256, 1);
  json["beam_intrinsics"]["beam_azimuth_angles"] = std::vector<int>(256, 1);
  EXPECT_THAT(complaintAbout(json), HasSubstr("more than UDP can carry"));
}

TEST(OusterMetadata, aFileThatIsNotThereIsNamed)
{
  EXPECT_THROW(loadOusterMetadata("/nowhere/left.json"), std::invalid_argument);
}
}  // namespace scanloom::ouster_metadata_unittest
