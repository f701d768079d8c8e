/** What holds for every model of Velodyne, Hesai and Robosense, by packets put together by hand. */
#include "input/lidar/internal/StampedDecoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

#include "hesaiPackets.h"
#include "input/lidar/LidarModels.h"
#include "robosensePackets.h"
#include "velodynePackets.h"

namespace scanloom::stamped_decoder_unittest
{
namespace
{
using Json = nlohmann::json;

struct Sensor
{
  StampedModel model;
  Json metadata;                                                              // of one return
  std::function<std::vector<std::uint8_t>(int azimuth, int returns)> packet;  // a firing each 0.2 degrees
  double range = 0, second_range = 0;                                         // m, of every channel
  std::uint16_t port = 2368;
  double lens = 0, lens_z = 0;  // m, of the lens from the axis, and above the origin
  bool y_forward = false;       // at azimuth 0; else x
  bool turns = true;            // while its channels fire
  bool two_returns = true;
};

Sensor velodyne(const VelodyneModel& model, const std::string& file)
{
  const auto packet = [model](int azimuth, int returns)
  {
    VelodyneContent content;
    content.product_id = model.product_id;
    content.return_mode = returns == 2 ? 0x39 : 0x37;
    content.azimuth = azimuth;
    content.azimuth_step = model.channels == 16 ? 40 : 20;  // two firings have one azimuth
    content.second_counts = 700;
    content.banks = model.channels == 128 ? 4 : 1;
    return velodynePacket(content);
  };
  return {model,
          Json::parse(readMetadataText(velodyneFile(file))),
          packet,
          0.5 * model.range_unit_mm,
          0.7 * model.range_unit_mm,
          2368,
          0,
          0,
          false,
          true,
          model.dual_return};
}

Sensor hesai(const HesaiModel& model)
{
  const auto packet = [model](int azimuth, int returns)
  {
    HesaiContent content;
    content.return_mode = returns == 2 ? 0x39 : 0x37;
    content.azimuth = azimuth;
    return hesaiPacket(model, content);
  };
  return {model, Json::parse(hesaiText(model)), packet, 2, 2.8, 2368, 0, 0, true, false, true};
}

Sensor robosense(const RobosenseModel& model)
{
  const auto packet = [model](int azimuth, int returns)
  {
    RobosenseContent content;
    content.returns = returns;
    content.azimuth = azimuth;
    return robosensePacket(model, content);
  };
  const double unit = model.unit_mm == 5 ? 2 : 1;
  return {model, Json::parse(robosenseText(model)), packet, 2 * unit, 3 * unit, 6699, model.lens_m, model.lens_z_m};
}

std::vector<Sensor> everySensor()
{
  std::vector<Sensor> sensors{velodyne(kVelodyneModels[0], "vlp16"), velodyne(kVelodyneModels[1], "hdl32e"),
                              velodyne(kVelodyneModels[2], "vlp32c"), velodyne(kVelodyneModels[3], "vls128")};
  std::transform(kHesaiModels.begin(), kHesaiModels.end(), std::back_inserter(sensors), hesai);
  std::transform(kRobosenseModels.begin(), kRobosenseModels.end(), std::back_inserter(sensors), robosense);
  return sensors;
}

std::string nameOf(const testing::TestParamInfo<Sensor>& row)
{
  std::string name = row.param.metadata["lidar"].get<std::string>() + "_" + std::string(row.param.model.name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
}  // namespace

class EveryStampedLidar : public testing::TestWithParam<Sensor>
{
 protected:
  std::unique_ptr<PacketDecoder> decoderOf(int returns, const Rigid& body_T_sensor = Rigid::identity()) const
  {
    Json metadata = sensor.metadata;
    metadata["returns"] = returns;
    return makeDecoder(metadata.dump(), "its file", body_T_sensor);
  }

  const Sensor sensor = GetParam();
  const std::size_t channels = static_cast<std::size_t>(sensor.model.channels);
  const std::unique_ptr<PacketDecoder> decoder = decoderOf(1);
};
INSTANTIATE_TEST_SUITE_P(Models, EveryStampedLidar, testing::ValuesIn(everySensor()), nameOf);

TEST_P(EveryStampedLidar, isFoundByItsFile)
{
  const LidarDescription& d = decoder->description();
  EXPECT_EQ(d.model, sensor.model.name);
  EXPECT_EQ(d.lidar_port, sensor.port);
  EXPECT_EQ(d.numbering, Numbering::Stamps);
  EXPECT_EQ(d.blockPeriod(), sensor.model.period);
  EXPECT_NEAR(d.columns_per_frame * seconds(sensor.model.period), 0.1, seconds(sensor.model.period));
  EXPECT_EQ(decoder->kind(sensor.packet(0, 1)), PacketKind::Lidar);
}

TEST_P(EveryStampedLidar, firesOneBlockPerPeriodWithAllReturns)
{
  const auto single = blocksOf(*decoder, sensor.packet(0, 1));
  ASSERT_EQ(single.size(), static_cast<std::size_t>(sensor.model.firings));
  for (std::size_t i = 1; i < single.size(); ++i)
    EXPECT_EQ((single[i].stamp - single[i - 1].stamp + Duration(3600s)) % Duration(3600s), sensor.model.period);
  if (!sensor.two_returns) return;

  const auto dual = decoderOf(2);
  const auto packet = sensor.packet(0, 2);
  ASSERT_EQ(dual->kind(packet), PacketKind::Lidar);
  EXPECT_EQ(blocksOf(*dual, packet).size(), single.size() / 2);
  EXPECT_EQ(dual->description().columns_per_packet, sensor.model.firings / 2);
  const PointCloud points = pointsOf(*dual, packet, 0);
  ASSERT_EQ(points.size(), 2 * channels);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(points.range[i], 1000 * (i < channels ? sensor.range : sensor.second_range), 1e-9);
}

/** Azimuths count clockwise from the axis that is forward; every channel at its own angles, the lens on the rotor. */
TEST_P(EveryStampedLidar, putsEveryChannelWhereTheManualSays)
{
  const std::vector<double> vertical_deg = sensor.metadata["vertical_angles_deg"],
                            azimuth_deg = sensor.metadata["azimuth_offsets_deg"],
                            offset_mm = sensor.metadata.value("vertical_offsets_mm", std::vector<double>(channels));
  const auto packet = sensor.packet(35950, 1);
  for (std::size_t block = 0; block < blocksOf(*decoder, packet).size(); ++block)
  {
    const PointCloud points = pointsOf(*decoder, packet, block);
    ASSERT_EQ(points.size(), channels);
    for (std::size_t i = 0; i < channels; ++i)
    {
      const double since = sensor.turns ? points.t[i] / static_cast<double>(sensor.model.period.count()) : 0;
      const double rotor = M_PI / 180 * (359.5 + 0.2 * (static_cast<double>(block) + since));
      const double azimuth = rotor + M_PI / 180 * azimuth_deg[i], vertical = M_PI / 180 * vertical_deg[i];
      const double level = sensor.range * std::cos(vertical);
      const double forward = level * std::cos(azimuth) + sensor.lens * std::cos(rotor),
                   right = level * std::sin(azimuth) + sensor.lens * std::sin(rotor),
                   up = sensor.range * std::sin(vertical) + sensor.lens_z + 1e-3 * offset_mm[i];
      const Eigen::Vector3d expected =
          sensor.y_forward ? Eigen::Vector3d(right, forward, up) : Eigen::Vector3d(forward, -right, up);
      EXPECT_LT((points.position(i).cast<double>() - expected).norm(), 2e-6) << block << ' ' << i;
    }
  }
}

TEST_P(EveryStampedLidar, countsRingsFromTheTopAndTimesFromTheFirstShot)
{
  const PointCloud points = pointsOf(*decoder, sensor.packet(0, 1), 0);
  std::vector<double> from_the_top(channels);
  for (std::size_t i = 0; i < channels; ++i)
    from_the_top.at(points.ring[i]) = sensor.metadata["vertical_angles_deg"][i];
  EXPECT_TRUE(std::is_sorted(from_the_top.rbegin(), from_the_top.rend()));
  const auto [first, last] = std::minmax_element(points.t.begin(), points.t.end());
  EXPECT_EQ(*first, 0);
  EXPECT_LT(Duration{*last}, sensor.model.period);
}

TEST_P(EveryStampedLidar, foldsTheExtrinsicsIn)
{
  const Rigid body_T_sensor = Rigid::fromXyzYawPitchRoll(1, 2, 3, 0.5, -0.1, 0.2);
  const auto packet = sensor.packet(0, 1);
  const PointCloud own = pointsOf(*decoder, packet, 1), body = pointsOf(*decoderOf(1, body_T_sensor), packet, 1);
  for (std::size_t i = 0; i < channels; ++i)
    EXPECT_LT((body_T_sensor * own.position(i).cast<double>() - body.position(i).cast<double>()).norm(), 2e-6);
}

TEST_P(EveryStampedLidar, refusesPacketsThatAreTooShort)
{
  auto packet = sensor.packet(0, 1);
  EXPECT_THROW(pointsOf(*decoder, packet, static_cast<std::size_t>(sensor.model.firings)), std::out_of_range);
  packet.pop_back();
  EXPECT_EQ(decoder->kind(packet), PacketKind::Malformed);
  EXPECT_THROW(blocksOf(*decoder, packet), std::out_of_range);
  EXPECT_EQ(decoder->kind({}), PacketKind::Malformed);
}

TEST_P(EveryStampedLidar, refusesPacketsWithAnotherNumberOfReturnsThanItsFileSays)
{
  if (sensor.model.name == "Helios-16P") GTEST_SKIP() << "its packets do not tell";
  EXPECT_EQ(decoder->kind(sensor.packet(0, 2)), PacketKind::Malformed);
  if (!sensor.two_returns) return;
  EXPECT_EQ(decoderOf(2)->kind(sensor.packet(0, 1)), PacketKind::Malformed);
}

struct Mistake
{
  const char* name;
  std::function<Sensor()> sensor;
  Json key;
  const char* says;
};
class MistakesInMetadata : public testing::TestWithParam<Mistake>
{
};
const auto vlp16 = [] { return velodyne(kVelodyneModels[0], "vlp16"); };
const auto vls128 = [] { return velodyne(kVelodyneModels[3], "vls128"); };
const auto xt32 = [] { return hesai(kHesaiModels[3]); };
const auto helios16P = [] { return robosense(kRobosenseModels[3]); };
INSTANTIATE_TEST_SUITE_P(
    Keys, MistakesInMetadata,
    testing::Values(Mistake{"noModel", vlp16, {{"model", nullptr}}, "model: is missing; known are VLP-16"},
                    Mistake{"otherVelodyne", vlp16, {{"model", "HDL-64E"}}, "'HDL-64E' is unknown; known are VLP-16"},
                    Mistake{"otherHesai", xt32, {{"model", "AT128"}}, "'AT128' is unknown; known are 40P"},
                    Mistake{"otherRobosense", helios16P, {{"model", "M1"}}, "'M1' is unknown; known are Helios-5515"},
                    Mistake{"tooFewAngles", xt32, {{"vertical_angles_deg", {1, 2}}}, "must have 32 numbers"},
                    Mistake{"noAngles", xt32, {{"vertical_angles_deg", nullptr}}, "or \"angles\": \"FILE.csv\""},
                    Mistake{"noOffsets", vlp16, {{"vertical_offsets_mm", nullptr}}, "expected 16 numbers"},
                    Mistake{"noSuchFile", xt32, {{"angles", "none.csv"}}, "none.csv: metadata file can't be read"},
                    Mistake{"upright", vlp16, {{"vertical_angles_deg", {200}}}, "must be a number from -90 to 90"},
                    Mistake{"fast", vlp16, {{"rpm", 12000}}, "rpm: must be a number from 300 to 1200"},
                    Mistake{"threeReturns", xt32, {{"returns", 3}}, "returns: must be a whole number from 1 to 2"},
                    Mistake{"twoOfVls128", vls128, {{"returns", 2}}, "two returns of the VLS-128 are not supported"},
                    Mistake{"oneEnd", helios16P, {{"field_of_view_deg", {90}}}, "must be [first, last]"}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

TEST_P(MistakesInMetadata, areSaidWithFileKeyAndCure)
{
  Json json = GetParam().sensor().metadata;
  json.update(GetParam().key);
  try
  {
    makeDecoder(json.dump(), "folder/front.json", Rigid::identity());
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& e)
  {
    EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr("folder/"), testing::HasSubstr(GetParam().says)));
  }
}
}  // namespace scanloom::stamped_decoder_unittest
