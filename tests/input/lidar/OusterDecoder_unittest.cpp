#include "input/lidar/OusterDecoder.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>

#include "captures.h"
#include "input/lidar/internal/OusterLayout.h"
#include "simpleMetadata.h"

namespace scanloom::ouster_decoder_unittest
{
namespace
{
std::map<PacketKind, int> kindsOf(const OusterDecoder& decoder, const std::filesystem::path& capture)
{
  std::map<PacketKind, int> kinds;
  for (const auto& payload : payloadsOf(capture)) ++kinds[decoder.kind(payload)];
  return kinds;
}

struct Recording
{
  std::string capture, metadata;
  int lidar_packets, imu_packets;
};

const std::vector<Recording> kRecordings{
    {"OS-0-32-U1_v2.2.0_1024x10", "OS-0-32-U1_v2.2.0_1024x10", 64, 10},
    {"OS-1-32-G_v2.1.1_1024x10", "OS-1-32-G_v2.1.1_1024x10", 64, 0},
    {"OS-1-64_1024x10_fw20", "OS-1-64_sensor_config_reduced", 64, 11},
    {"OS-2-128-U1_v2.3.0_1024x10", "OS-2-128-U1_v2.3.0_1024x10", 64, 10},
    {"OS-1-128_v2.3.0_1024x10_lb_n3", "OS-1-128_v2.3.0_1024x10", 192, 30},
    {"OS-1-128_767798045_1024x10_20230712_120049", "OS-1-128_767798045_1024x10_20230712_120049", 8, 2},
    {"crc_test", "crc_test", 34, 10},
    {"windowed_frame1", "windowed_frame1_0", 17, 10},
    {"duplicate_id", "duplicate_id", 1, 0},
    {"shot_limiting_test", "shot_limiting_test", 1, 0},
};
}  // namespace

TEST(OusterDecoder, knowsEveryPacketOfEveryRecording)
{
  for (const Recording& r : kRecordings)
  {
    SCOPED_TRACE(r.capture);
    SCANLOOM_NEEDS_DATA(capture, kOusterCaptures + r.capture + ".pcap");
    SCANLOOM_NEEDS_DATA(metadata, kOusterCaptures + r.metadata + ".json");
    std::map<PacketKind, int> expected{{PacketKind::Lidar, r.lidar_packets}};
    if (r.imu_packets > 0) expected[PacketKind::Imu] = r.imu_packets;
    EXPECT_EQ(kindsOf(decoderOf(metadata), capture), expected);
  }
}

TEST(OusterDecoder, packetsHaveTheSizesOfTheManuals)
{
  const auto size = [](const std::string& profile, int channels)
  { return layoutOf(simpleMetadata(profile, channels)).lidarPacketBytes(); };
  EXPECT_EQ(size("LEGACY", 32), 6464u);
  EXPECT_EQ(size("LEGACY", 64), 12608u);
  EXPECT_EQ(size("LEGACY", 128), 24896u);
  EXPECT_EQ(size("RNG19_RFL8_SIG16_NIR16", 128), 24832u);
  EXPECT_EQ(size("RNG19_RFL8_SIG16_NIR16_DUAL", 128), 33024u);
  EXPECT_EQ(size("RNG15_RFL8_NIR8", 128), 8448u);
  EXPECT_EQ(size("FUSA_RNG15_RFL8_NIR8_DUAL", 128), 16640u);
}

TEST(OusterDecoder, everyCrcOfTheCrcCaptureHoldsAndEveryFlippedByteIsFound)
{
  SCANLOOM_NEEDS_DATA(capture, kOusterCaptures + "crc_test.pcap");
  SCANLOOM_NEEDS_DATA(metadata, kOusterCaptures + "crc_test.json");
  const OusterDecoder decoder = decoderOf(metadata);
  std::vector<std::uint8_t> first;
  for (const auto& packet : payloadsOf(capture))
  {
    if (packet.size() != decoder.layout().lidarPacketBytes()) continue;
    const std::size_t end = packet.size() - 8;
    EXPECT_EQ(load<std::uint64_t>(packet, end), crc64(Bytes(packet).slice(0, end)));
    if (first.empty()) first = packet;
  }
  ASSERT_FALSE(first.empty());
  for (std::size_t i = 2; i < first.size(); i += 97)  // bytes 0 and 1 are the type
  {
    auto damaged = first;
    damaged[i] ^= 0x10;
    EXPECT_EQ(decoder.kind(damaged), PacketKind::BadCrc) << "byte " << i;
  }
}

TEST(OusterDecoder, rejectsEachOfAHundredThousandFlipsAndBursts)  // F8
{
  const OusterMetadata metadata = simpleMetadata("RNG15_RFL8_NIR8");
  const OusterDecoder decoder(metadata, Rigid::identity());
  auto packet = OusterEncoder(metadata).lidarPacket(randomColumns(metadata, 1));
  store(packet, packet.size() - 8, crc64(Bytes(packet).slice(0, packet.size() - 8)));
  ASSERT_EQ(decoder.kind(packet), PacketKind::Lidar);

  std::mt19937_64 random(8);
  for (int i = 0; i < 100000; ++i)
  {
    // Bursts of up to 64 bits, the CRC's own too; the packet's type is looked at before the CRC.
    const std::uint64_t burst = i % 2 ? 1 : random() | 1;
    const std::size_t at = 2 + random() % (packet.size() - 2 - sizeof burst);
    const auto before = load<std::uint64_t>(packet, at);
    store(packet, at, before ^ burst);
    ASSERT_EQ(decoder.kind(packet), PacketKind::BadCrc) << "byte " << at;
    store(packet, at, before);
  }
  EXPECT_EQ(decoder.kind(packet), PacketKind::Lidar);
}

TEST(OusterDecoder, firmwareThatComputesNoCrcIsNotBlamedForIt)
{
  // 2.2 fills the field with 0, 2.3 with 0xDEADBEEF0000C0DE: see the captures of these versions above.
  const OusterMetadata metadata = simpleMetadata("RNG15_RFL8_NIR8");
  const OusterDecoder decoder(metadata, Rigid::identity());
  auto packet = OusterEncoder(metadata).lidarPacket(randomColumns(metadata, 1));
  const std::size_t end = packet.size() - 8;
  for (const auto& [stored, kind] : {std::pair{std::uint64_t{0}, PacketKind::Lidar},
                                     {std::uint64_t{0xDEADBEEF0000C0DE}, PacketKind::Lidar},
                                     {std::uint64_t{1}, PacketKind::BadCrc}})
  {
    store(packet, end, stored);
    EXPECT_EQ(decoder.kind(packet), kind);
  }
}

TEST(OusterDecoder, aNeighbourOnTheSamePortIsForeignByItsSerialNumber)
{
  for (const std::string profile : {"RNG15_RFL8_NIR8", "FUSA_RNG15_RFL8_NIR8_DUAL"})
  {
    const OusterMetadata ours = simpleMetadata(profile);
    OusterMetadata neighbour = ours;
    neighbour.serial = "122247000786";
    OusterMetadata wider = simpleMetadata(profile, 16);
    wider.serial = "122247000787";
    OusterMetadata restarted = ours;
    restarted.init_id = 1;
    const OusterDecoder decoder(ours, Rigid::identity());
    const auto kindFrom = [&](const OusterMetadata& m)
    { return decoder.kind(OusterEncoder(m).lidarPacket(randomColumns(m, 1))); };
    EXPECT_EQ(kindFrom(ours), PacketKind::Lidar);
    EXPECT_EQ(kindFrom(neighbour), PacketKind::Foreign);
    EXPECT_EQ(kindFrom(wider), PacketKind::Foreign) << "of another size";
    EXPECT_EQ(kindFrom(restarted), PacketKind::Lidar) << "the same sensor, started again";
  }
}

TEST(OusterDecoder, serialNumbersThatAreNotKnownAreNotCompared)
{
  OusterMetadata ours = simpleMetadata("RNG15_RFL8_NIR8"), neighbour = ours;
  neighbour.serial = "122247000786";
  const auto packet = OusterEncoder(neighbour).lidarPacket(randomColumns(ours, 1));
  for (const std::string serial : {"", "000000000000", "unknown"})
  {
    ours.serial = serial;
    EXPECT_EQ(OusterDecoder(ours, Rigid::identity()).kind(packet), PacketKind::Lidar) << serial;
  }
}

TEST(OusterDecoder, twoSensorsOnOnePortAreToldApart)
{
  SCANLOOM_NEEDS_DATA(capture, kOusterCaptures + "same_ports.pcap");
  SCANLOOM_NEEDS_DATA(fusa, kOusterCaptures + "same_ports.1.json");
  SCANLOOM_NEEDS_DATA(legacy, kOusterCaptures + "same_ports.2.json");
  // One lidar packet each; LEGACY IMU packets say nothing about who sent them.
  EXPECT_EQ(kindsOf(decoderOf(fusa), capture),
            (std::map<PacketKind, int>{{PacketKind::Lidar, 1}, {PacketKind::Imu, 2}, {PacketKind::Malformed, 1}}));
  EXPECT_EQ(kindsOf(decoderOf(legacy), capture),
            (std::map<PacketKind, int>{{PacketKind::Lidar, 1}, {PacketKind::Imu, 2}, {PacketKind::Malformed, 1}}));
}

TEST(OusterDecoder, aPacketOfAnotherMakerIsMalformed)
{
  SCANLOOM_NEEDS_DATA(capture, kOusterCaptures + "VLI-16-one-packet.pcap");
  for (const std::string profile : {"LEGACY", "RNG15_RFL8_NIR8", "FUSA_RNG15_RFL8_NIR8_DUAL"})
    EXPECT_EQ(kindsOf(OusterDecoder(simpleMetadata(profile), Rigid::identity()), capture),
              (std::map<PacketKind, int>{{PacketKind::Malformed, 1}}));
}

TEST(OusterDecoder, theHeaderTellsOfHeatAndShotLimiting)
{
  SCANLOOM_NEEDS_DATA(capture, kOusterCaptures + "shot_limiting_test.pcap");
  SCANLOOM_NEEDS_DATA(metadata, kOusterCaptures + "shot_limiting_test.json");
  const OusterDecoder decoder = decoderOf(metadata);
  const PacketHeader header = decoder.header(payloadsOf(capture).front());
  EXPECT_EQ(header.serial, 122406002141u);
  EXPECT_EQ(header.init_id, 15109686u);
  EXPECT_EQ(header.alert_flags, 0x98);
  EXPECT_EQ(header.thermal_status, 1);
  EXPECT_EQ(header.shot_limiting_status, 1);
}

TEST(OusterDecoder, theIdentityInRealHeadersIsThatOfTheMetadata)
{
  for (const std::string name : {"OS-1-128_767798045_1024x10_20230712_120049", "OS-2-128-U1_v2.3.0_1024x10"})
  {
    SCANLOOM_NEEDS_DATA(capture, kOusterCaptures + name + ".pcap");
    SCANLOOM_NEEDS_DATA(metadata, kOusterCaptures + name + ".json");
    const OusterDecoder decoder = decoderOf(metadata);
    for (const auto& packet : payloadsOf(capture))
    {
      if (decoder.kind(packet) != PacketKind::Lidar) continue;
      EXPECT_EQ(decoder.header(packet).serial, serialNumber(decoder.metadata())) << name;
      EXPECT_EQ(decoder.header(packet).init_id, decoder.metadata().init_id) << name;
    }
  }
}

TEST(OusterDecoder, aTurnWithAnAzimuthWindowHasItsValidColumnsInside)
{
  SCANLOOM_NEEDS_DATA(capture, kOusterCaptures + "windowed_frame1.pcap");
  SCANLOOM_NEEDS_DATA(metadata, kOusterCaptures + "windowed_frame1_0.json");
  const OusterDecoder decoder = decoderOf(metadata);
  EXPECT_EQ(decoder.description().first_column, 1);
  EXPECT_EQ(decoder.description().last_column, 256);
  int valid = 0, invalid = 0;
  std::vector<MeasurementBlock> blocks;
  for (const auto& packet : payloadsOf(capture))
  {
    if (decoder.kind(packet) != PacketKind::Lidar) continue;
    decoder.readBlocks(packet, blocks);
    for (const MeasurementBlock& block : blocks)
    {
      (block.valid ? valid : invalid) += 1;
      EXPECT_EQ(block.valid, block.measurement_id >= 1 && block.measurement_id <= 256) << block.measurement_id;
    }
  }
  EXPECT_EQ(valid, 256);
  EXPECT_EQ(invalid, 16);
}

TEST(OusterDecoder, aSensorAtRestFeelsGravity)
{
  for (const auto& [name, json] : {std::pair{"OS-1-64_1024x10_fw20", "OS-1-64_sensor_config_reduced"},
                                   {"crc_test", "crc_test"},
                                   {"windowed_frame1", "windowed_frame1_0"}})
  {
    SCANLOOM_NEEDS_DATA(capture, kOusterCaptures + name + ".pcap");
    SCANLOOM_NEEDS_DATA(metadata, kOusterCaptures + json + ".json");
    const OusterDecoder decoder = decoderOf(metadata);
    Timestamp last;
    for (const auto& packet : payloadsOf(capture))
    {
      if (decoder.kind(packet) != PacketKind::Imu) continue;
      const auto samples = decoder.imuSamples(packet);
      ASSERT_EQ(samples.size(), 1u);
      EXPECT_NEAR(samples[0].accel.norm(), 9.81, 0.6) << name;
      EXPECT_LT(samples[0].gyro.norm(), 0.05) << name;
      if (last != Timestamp{})
      {
        EXPECT_NEAR(seconds(samples[0].stamp - last), 0.01, 1e-4) << name;
      }
      last = samples[0].stamp;
    }
    EXPECT_NE(last, Timestamp{});
  }
}

TEST(OusterDecoder, zonePacketsAreOthers)
{
  const OusterMetadata metadata = simpleMetadata("RNG15_RFL8_NIR8_ZONE16");
  std::vector<std::uint8_t> packet(kOusterZonePacketBytes);
  store(packet, 0, std::uint16_t{3});
  EXPECT_EQ(OusterDecoder(metadata, Rigid::identity()).kind(packet), PacketKind::Other);
}

TEST(OusterDecoder, readingsThatAreNoNumbersAreLeftOut)
{
  OusterMetadata metadata = simpleMetadata("RNG19_RFL8_SIG16_NIR16");
  metadata.imu_profile = OusterImuProfile::Accel32Gyro32Nmea;
  metadata.imu_measurements_per_packet = 3;
  std::vector<ImuSample> samples(3);
  for (std::size_t i = 0; i < 3; ++i) samples[i].stamp = fromNanoseconds(static_cast<std::int64_t>(3 - i));
  samples[1].accel.y() = std::numeric_limits<double>::quiet_NaN();
  const auto decoded =
      OusterDecoder(metadata, Rigid::identity()).imuSamples(OusterEncoder(metadata).imuPacket(samples));
  ASSERT_EQ(decoded.size(), 2u);
  EXPECT_EQ(decoded[0].stamp, fromNanoseconds(1)) << "oldest first";
  EXPECT_EQ(decoded[1].stamp, fromNanoseconds(3));
}

TEST(OusterDecoder, readsTheOldAndTheNewFileOfADualRecordingByAnotherGenerator)
{
  SCANLOOM_NEEDS_DATA(capture, "recordings/sparse/recording.pcap");
  SCANLOOM_NEEDS_DATA(left, "recordings/sparse/left.json");
  SCANLOOM_NEEDS_DATA(right, "recordings/sparse/right.json");
  const OusterDecoder decoders[] = {decoderOf(left), decoderOf(right)};
  std::map<PacketKind, int> own, crossed;
  CaptureReader reader(capture);
  for (Datagram datagram; reader.next(datagram);)
  {
    const std::size_t side = datagram.destination_port < 7504 ? 0 : 1;
    ++own[decoders[side].kind(datagram.payload)];
    ++crossed[decoders[1 - side].kind(datagram.payload)];
  }
  EXPECT_EQ(own.size(), 2u) << "lidar and IMU packets and nothing else";
  EXPECT_GT(own[PacketKind::Lidar], 2 * 30 * 310);  // two sensors, 30 s, 320 packets per second
  EXPECT_GT(own[PacketKind::Imu], 2 * 30 * 95);
  EXPECT_EQ(crossed[PacketKind::Foreign], own[PacketKind::Lidar]);
  EXPECT_EQ(crossed[PacketKind::Lidar], 0);
}
}  // namespace scanloom::ouster_decoder_unittest
