#include "input/lidar/OusterEncoder.h"

#include <gtest/gtest.h>

#include "input/lidar/OusterDecoder.h"
#include "simpleMetadata.h"

namespace scanloom::ouster_encoder_unittest
{
namespace
{
/** What the decoder should make of a column, said without the decoder's own loops. */
struct ExpectedPoint
{
  std::uint16_t ring;
  OusterReturn echo;
  std::uint16_t near_ir;
};

std::vector<ExpectedPoint> expectedPoints(const OusterColumn& column, const OusterProfile& profile)
{
  const bool has_signal = profile[OusterField::Signal].present(), has_near_ir = profile[OusterField::NearIr].present();
  std::vector<ExpectedPoint> first, second;
  for (std::uint16_t ring = 0; ring < column.readings.size(); ++ring)
  {
    OusterReading r = column.readings[ring];
    if (!has_signal) r.first.signal = r.second.signal = 0;
    if (!profile[OusterField::Signal2].present()) r.second.signal = 0;
    if (!has_near_ir) r.near_ir = 0;
    if (r.first.range_mm != 0) first.push_back({ring, r.first, r.near_ir});
    if (profile.returns() == 2 && r.second.range_mm != 0 && r.second.range_mm != r.first.range_mm)
      second.push_back({ring, r.second, r.near_ir});
  }
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

class EveryProfile : public testing::TestWithParam<std::string>
{
};
}  // namespace

TEST_P(EveryProfile, isDecodedToWhatWasEncoded)
{
  for (const int columns_per_packet : {1, 8, 16})
  {
    const OusterMetadata metadata = simpleMetadata(GetParam(), 9, columns_per_packet);
    const OusterDecoder decoder(metadata, Rigid::identity());
    const auto columns = randomColumns(metadata, 1);
    const auto packet = OusterEncoder(metadata).lidarPacket(columns);
    ASSERT_EQ(decoder.kind(packet), PacketKind::Lidar);

    std::vector<MeasurementBlock> blocks;
    decoder.readBlocks(packet, blocks);
    ASSERT_EQ(blocks.size(), columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      EXPECT_EQ(blocks[i].stamp, columns[i].stamp);
      EXPECT_EQ(blocks[i].frame_id, 7u);
      EXPECT_EQ(blocks[i].measurement_id, columns[i].measurement_id);
      EXPECT_EQ(blocks[i].index, i);
      EXPECT_TRUE(blocks[i].valid);

      PointCloud points;
      decoder.appendPoints(packet, i, 1234, 3, points);
      const auto expected = expectedPoints(columns[i], *decoder.layout().profile);
      ASSERT_EQ(points.size(), expected.size());
      for (std::size_t p = 0; p < points.size(); ++p)
      {
        EXPECT_EQ(points.ring[p], expected[p].ring);
        EXPECT_EQ(points.range[p], expected[p].echo.range_mm);
        EXPECT_EQ(points.intensity[p], expected[p].echo.reflectivity);
        EXPECT_EQ(points.signal[p], expected[p].echo.signal);
        EXPECT_EQ(points.near_ir[p], expected[p].near_ir);
        EXPECT_EQ(points.column[p], columns[i].measurement_id);
        EXPECT_EQ(points.t[p], 1234);
        EXPECT_EQ(points.sensor_id[p], 3);
      }
    }
  }
}

TEST_P(EveryProfile, bearsTheSensorsIdentityInItsHeader)
{
  const OusterMetadata metadata = simpleMetadata(GetParam());
  const OusterDecoder decoder(metadata, Rigid::identity());
  const std::uint32_t frame_id = 65535;
  const PacketHeader header = decoder.header(OusterEncoder(metadata).lidarPacket(randomColumns(metadata, 2, frame_id)));
  EXPECT_EQ(header.frame_id, frame_id);
  const bool legacy = GetParam() == "LEGACY";
  EXPECT_EQ(header.init_id.has_value(), !legacy);
  EXPECT_EQ(header.init_id.value_or(0xABCDEF), 0xABCDEFu);
  EXPECT_EQ(header.serial.value_or(122247000785), 122247000785u);
  EXPECT_EQ(decoder.description().frame_id_modulus,
            GetParam() == "FUSA_RNG15_RFL8_NIR8_DUAL" ? 0x100000000u : 0x10000u);
}

TEST_P(EveryProfile, givesNoPointsFromInvalidColumns)
{
  const OusterMetadata metadata = simpleMetadata(GetParam());
  const OusterDecoder decoder(metadata, Rigid::identity());
  auto columns = randomColumns(metadata, 3);
  columns[4].valid = false;
  columns[5].measurement_id = 512;  // the turn has 0 to 511
  columns[6].stamp = fromNanoseconds(std::int64_t{1} << 62);
  const auto packet = OusterEncoder(metadata).lidarPacket(columns);

  std::vector<MeasurementBlock> blocks;
  decoder.readBlocks(packet, blocks);
  PointCloud points;
  for (const std::size_t i : {4u, 5u, 6u})
  {
    EXPECT_FALSE(blocks[i].valid);
    decoder.appendPoints(packet, i, 0, 0, points);
  }
  EXPECT_TRUE(points.empty());
}

TEST_P(EveryProfile, losesNothingWhenPacketsAreCutShort)
{
  const OusterMetadata metadata = simpleMetadata(GetParam());
  const OusterDecoder decoder(metadata, Rigid::identity());
  const auto packet = OusterEncoder(metadata).lidarPacket(randomColumns(metadata, 4));
  const std::size_t enough = decoder.layout().columnOffset(15) + decoder.layout().columnBytes();
  std::vector<MeasurementBlock> blocks;
  PointCloud points;
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{31}, enough - 1})
  {
    const Bytes cut(packet.data(), size);
    EXPECT_NE(decoder.kind(cut), PacketKind::Lidar);
    EXPECT_THROW(decoder.readBlocks(cut, blocks), std::out_of_range);
    EXPECT_THROW(decoder.appendPoints(cut, 15, 0, 0, points), std::out_of_range);
  }
  EXPECT_THROW(decoder.appendPoints(packet, 16, 0, 0, points), std::out_of_range);
}

namespace
{
std::vector<std::string> everyProfile()
{
  std::vector<std::string> names;
  for (const OusterProfile& p : kOusterProfiles) names.emplace_back(p.name);
  return names;
}
}  // namespace
INSTANTIATE_TEST_SUITE_P(Ouster, EveryProfile, testing::ValuesIn(everyProfile()),
                         [](const auto& p) { return p.param; });

TEST(OusterEncoder, roundsRangesToTheStepsOfTheProfileAndDropsWhatIsOutOfReach)
{
  const OusterMetadata metadata = simpleMetadata("RNG15_RFL8_NIR8", 4, 1);
  auto columns = randomColumns(metadata, 5);
  columns[0].readings = {
      {{1003, 1, 0}, {}, 7}, {{1004, 1, 0}, {}, 8}, {{262136, 1, 0}, {}, 5000}, {{262137, 1, 0}, {}, 0}};
  PointCloud points;
  OusterDecoder(metadata, Rigid::identity())
      .appendPoints(OusterEncoder(metadata).lidarPacket(columns), 0, 0, 0, points);
  EXPECT_EQ(points.range, (std::vector<std::uint32_t>{1000, 1008, 262136}));
  EXPECT_EQ(points.near_ir, (std::vector<std::uint16_t>{0, 16, 4080}));
}

TEST(OusterEncoder, refusesColumnsAndReadingsThatDoNotFillAPacket)
{
  const OusterMetadata metadata = simpleMetadata("LEGACY");
  const OusterEncoder encoder(metadata);
  auto columns = randomColumns(metadata, 6);
  columns[3].readings.pop_back();
  EXPECT_THROW(encoder.lidarPacket(columns), std::invalid_argument);
  columns.pop_back();
  EXPECT_THROW(encoder.lidarPacket(columns), std::invalid_argument);
  EXPECT_THROW(encoder.imuPacket({}), std::invalid_argument);
}

TEST(OusterEncoder, imuSamplesOfBothFormatsComeBackInSiUnits)
{
  for (const OusterImuProfile profile : {OusterImuProfile::Legacy, OusterImuProfile::Accel32Gyro32Nmea})
    for (const OusterHeader header : {OusterHeader::Standard, OusterHeader::Fusa})
    {
      OusterMetadata metadata = simpleMetadata("RNG19_RFL8_SIG16_NIR16");
      metadata.imu_profile = profile;
      metadata.header_type = header;
      metadata.imu_measurements_per_packet = 8;
      const OusterEncoder encoder(metadata);
      std::vector<ImuSample> samples(encoder.imuSamplesPerPacket());
      for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = {fromNanoseconds(1000 + static_cast<std::int64_t>(i)), {0.1, -0.2, 0.3 + i}, {1, 2, 9.80665}};

      const OusterDecoder decoder(metadata, Rigid::identity());
      const auto packet = encoder.imuPacket(samples);
      ASSERT_EQ(decoder.kind(packet), PacketKind::Imu);
      const auto decoded = decoder.imuSamples(packet);
      ASSERT_EQ(decoded.size(), samples.size());
      for (std::size_t i = 0; i < samples.size(); ++i)
      {
        EXPECT_EQ(decoded[i].stamp, samples[i].stamp);
        EXPECT_LT((decoded[i].gyro - samples[i].gyro).norm(), 1e-6);
        EXPECT_LT((decoded[i].accel - samples[i].accel).norm(), 1e-6);
      }
    }
}

TEST(OusterEncoder, anImuPacketOfEightMeasurementsHas452Bytes)
{
  OusterMetadata metadata = simpleMetadata("RNG19_RFL8_SIG16_NIR16");
  metadata.imu_profile = OusterImuProfile::Accel32Gyro32Nmea;
  metadata.imu_measurements_per_packet = 8;
  EXPECT_EQ(layoutOf(metadata).imuPacketBytes(), 452u);
}
}  // namespace scanloom::ouster_encoder_unittest
