/** One packet of every profile into points, beside a memcpy of the same bytes. */
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <random>

#include "lidar/Crc64.h"
#include "lidar/OusterDecoder.h"
#include "lidar/OusterEncoder.h"

using namespace scanloom;

namespace
{
OusterMetadata sensor(const OusterProfile& profile, int channels)
{
  OusterMetadata m;
  m.lidar_mode = "1024x10";
  m.lidar_profile = std::string(profile.name);
  m.channels = channels;
  m.columns_per_frame = 1024;
  m.last_column = 1023;
  m.frame_rate = 10;
  for (int i = 0; i < channels; ++i)
  {
    m.beam_altitude_deg.push_back(45.0 - 90.0 * i / channels);
    m.beam_azimuth_deg.push_back(3.0 * std::sin(i));
  }
  m.beam_to_lidar_mm(0, 3) = 27.67;
  m.lidar_to_sensor_mm.diagonal() << -1, -1, 1, 1;
  return m;
}

/** Nine of ten channels see something, as in a forest. */
std::vector<std::uint8_t> packetOf(const OusterMetadata& m)
{
  std::mt19937 random(1);
  const auto upTo = [&random](std::uint32_t most)
  { return std::uniform_int_distribution<std::uint32_t>(0, most)(random); };
  std::vector<OusterColumn> columns(static_cast<std::size_t>(m.columns_per_packet));
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    columns[i].measurement_id = static_cast<std::uint16_t>(i);
    for (int c = 0; c < m.channels; ++c)
      columns[i].readings.push_back(
          {{upTo(9) == 0 ? 0 : 1000 + upTo(60000), 10, 20}, {upTo(4) == 0 ? 2000 + upTo(60000) : 0, 5, 6}, 30});
  }
  return OusterEncoder(m).lidarPacket(columns);
}

void decode(benchmark::State& state, const OusterProfile& profile, int channels)
{
  const OusterMetadata m = sensor(profile, channels);
  const OusterDecoder decoder(m, Rigid::fromXyzYawPitchRoll(1, 2, 3, 0.1, 0.2, 0.3));
  const auto packet = packetOf(m);
  PointCloud points;
  std::vector<MeasurementBlock> blocks;
  for (auto _ : state)
  {
    points.clear();
    decoder.readBlocks(packet, blocks);
    for (const MeasurementBlock& block : blocks) decoder.appendPoints(packet, block.index, 0, 0, points);
    benchmark::DoNotOptimize(points.x.data());
    benchmark::ClobberMemory();
  }
  state.counters["points"] = static_cast<double>(points.size());
}

void copy(benchmark::State& state, const OusterProfile& profile, int channels)
{
  const auto packet = packetOf(sensor(profile, channels));
  std::vector<std::uint8_t> target(packet.size());
  for (auto _ : state)
  {
    std::memcpy(target.data(), packet.data(), packet.size());
    benchmark::DoNotOptimize(target.data());
    benchmark::ClobberMemory();
  }
}

void checksum(benchmark::State& state)
{
  const std::vector<std::uint8_t> packet(24832, 0x5A);
  for (auto _ : state) benchmark::DoNotOptimize(crc64(packet));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * packet.size()));
}
BENCHMARK(checksum)->Name("crc64/24832");

const bool kRegistered = []
{
  for (const OusterProfile& profile : kOusterProfiles)
  {
    const int channels = profile.name == "LEGACY" ? 64 : 128;
    const std::string name = std::string(profile.name) + "/" + std::to_string(channels);
    benchmark::RegisterBenchmark(("decode/" + name).c_str(), decode, profile, channels);
    benchmark::RegisterBenchmark(("memcpy/" + name).c_str(), copy, profile, channels);
  }
  return true;
}();
}  // namespace
