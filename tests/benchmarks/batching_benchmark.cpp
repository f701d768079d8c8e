/**
 * From packets to scans in the body frame, compared with a memcpy of the same packets. One thread.
 *
 *   merge/<PROFILE>/<channels>/<sensors>/<kernel>   TimeBatcher::push, all fields; the packets bear no CRC
 *   merge_crc/...                                   the same, a valid CRC-64 in every packet
 *   order/...                                       TimeBatcher::push without making points
 *   decode/...                                      kind, readBlocks and appendPoints, without TimeBatcher
 *   store/...                                       zeros into the arrays of as many points: what memory alone takes
 *   crc/...                                         CRC-64 alone
 *
 * One turn of packets (64) per sensor is cycled, for 20 ms of work and 20 ms of copies in turn. `us_per_packet` is the
 * median over turns, `x_memcpy` its ratio to the median of a memcpy of these packets, one by one, into one buffer.
 */
#include "RigOfPackets.h"
#include "base/core/Statistics.h"
#include "support/pushPacket.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>

using namespace scanloom;
using namespace scanloom::bench;

namespace
{
/** Processor time of this thread, with page faults, without what else the machine does. */
Duration threadTime()
{
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return std::chrono::seconds{now.tv_sec} + Duration{now.tv_nsec};
}

/** Calls `turn`, which returns how many points it made, for a while; a time per turn. */
template <typename OneTurn>
std::size_t repeat(Rig& rig, std::vector<double>& micros, OneTurn&& turn)
{
  std::size_t points = 0;
  for (Duration spent{0}; spent < 20ms;)
  {
    rig.advance();
    const Duration begin = threadTime();
    points = turn();
    const Duration time = threadTime() - begin;
    micros.push_back(1e6 * seconds(time));
    spent += time;
  }
  return points;
}

/** Times `work` and a memcpy of the same packets, in turns. */
template <typename Work>
void besideMemcpy(benchmark::State& state, Rig& rig, Work&& work)
{
  Packet target(rig.packetBytes());
  const auto copyIntoTarget = [&target](std::size_t, const Packet& packet, Timestamp)
  {
    std::memcpy(target.data(), packet.data(), packet.size());
    benchmark::DoNotOptimize(target.data());
    benchmark::ClobberMemory();
  };
  const auto copyAll = [&]
  {
    rig.forEachPacket(copyIntoTarget);
    return std::size_t{0};
  };

  std::vector<double> working, copying;
  repeat(rig, working, work);  // until all buffers have grown
  working.clear();
  std::size_t points = 0;
  for (auto _ : state)
  {
    points = repeat(rig, working, work);
    state.PauseTiming();
    repeat(rig, copying, copyAll);
    state.ResumeTiming();
  }
  const auto packets = static_cast<double>(rig.packets());
  state.counters["us_per_packet"] = upperMedian(working) / packets;
  state.counters["memcpy_us"] = upperMedian(copying) / packets;
  state.counters["x_memcpy"] = upperMedian(working) / upperMedian(copying);
  state.counters["points"] = static_cast<double>(points) / packets;
}

/** A decoder whose points cost nothing. */
class PointlessDecoder : public OusterDecoder
{
 public:
  using OusterDecoder::OusterDecoder;
  void appendPoints(Bytes, std::size_t, std::int32_t, std::uint8_t, PointCloud&) const override {}
};

template <typename Decoder>
void merge(benchmark::State& state, const OusterProfile& profile, int channels, int sensors, Crc crc, Kernel kernel)
{
  Rig rig(profile, channels, sensors, crc);
  TimeBatcher batcher(rig.lidars<Decoder>(kernel), {});
  const auto oneTurn = [&]
  {
    std::size_t points = 0;
    rig.forEachPacket(
        [&](std::size_t lidar, const Packet& packet, Timestamp received)
        {
          for (const Scan& scan : push(batcher, lidar, packet, received)) points += scan.points.size();
        });
    return points;
  };
  besideMemcpy(state, rig, oneTurn);
}

void decodePacket(const PacketDecoder& decoder, std::size_t lidar, const Packet& packet,
                  std::vector<MeasurementBlock>& blocks, PointCloud& points)
{
  if (decoder.kind(packet) != PacketKind::Lidar) return;
  decoder.readBlocks(packet, blocks);
  for (const MeasurementBlock& block : blocks)
    decoder.appendPoints(packet, block.index, 0, static_cast<std::uint8_t>(lidar), points);
}

void decode(benchmark::State& state, const OusterProfile& profile, int channels, int sensors, Crc crc, Kernel kernel)
{
  Rig rig(profile, channels, sensors, crc);
  const std::vector<BatchedLidar> lidars = rig.lidars<OusterDecoder>(kernel);
  PointCloud points;
  std::vector<MeasurementBlock> blocks;
  const auto oneTurn = [&]
  {
    points.clear();
    rig.forEachPacket([&](std::size_t lidar, const Packet& packet, Timestamp)
                      { decodePacket(*lidars[lidar].decoder, lidar, packet, blocks, points); });
    return points.size();
  };
  besideMemcpy(state, rig, oneTurn);
}

void store(benchmark::State& state, const OusterProfile& profile, int channels, int sensors, Crc crc, Kernel kernel)
{
  Rig rig(profile, channels, sensors, crc);
  const std::vector<BatchedLidar> lidars = rig.lidars<OusterDecoder>(kernel);
  PointCloud points;
  std::vector<MeasurementBlock> blocks;
  std::vector<std::size_t> ends;
  rig.forEachPacket(
      [&](std::size_t lidar, const Packet& packet, Timestamp)
      {
        decodePacket(*lidars[lidar].decoder, lidar, packet, blocks, points);
        ends.push_back(points.size());
      });
  const auto oneTurn = [&]
  {
    points.clear();
    for (const std::size_t end : ends) points.resize(end);
    return points.size();
  };
  besideMemcpy(state, rig, oneTurn);
}

void checksum(benchmark::State& state, const OusterProfile& profile, int channels, int sensors, Crc crc, Kernel)
{
  Rig rig(profile, channels, sensors, crc);
  const auto oneTurn = [&]
  {
    rig.forEachPacket([&](std::size_t, const Packet& packet, Timestamp) { benchmark::DoNotOptimize(crc64(packet)); });
    return std::size_t{0};
  };
  besideMemcpy(state, rig, oneTurn);
}

using Row = void (*)(benchmark::State&, const OusterProfile&, int channels, int sensors, Crc, Kernel);

void add(const std::string& name, Row row, const OusterProfile& profile, int channels, int sensors, Crc crc,
         Kernel kernel)
{
  const std::string full = fmt::format("{}/{}/{}/{}/{}", name, profile.name, channels, sensors, nameOf(kernel));
  benchmark::RegisterBenchmark(full.c_str(), row, profile, channels, sensors, crc, kernel)
      ->Unit(benchmark::kMillisecond);
}

/** Measured with 1, 2, 4 and 8 sensors; the other profiles with 2. */
bool isCommon(const OusterProfile& p)
{
  return p.name == "LEGACY" || p.name == "RNG19_RFL8_SIG16_NIR16" || p.name == "RNG15_RFL8_NIR8" ||
         p.name == "RNG19_RFL8_SIG16_NIR16_DUAL";
}

void addProfile(const OusterProfile& profile, Kernel kernel)
{
  const int channels = profile.name == "LEGACY" ? 64 : 128;
  add("merge", merge<OusterDecoder>, profile, channels, 2, Crc::None, kernel);
  if (!isCommon(profile)) return;
  for (const int sensors : {1, 4, 8}) add("merge", merge<OusterDecoder>, profile, channels, sensors, Crc::None, kernel);
  add("merge_crc", merge<OusterDecoder>, profile, channels, 2, Crc::Valid, kernel);
  add("decode", decode, profile, channels, 1, Crc::None, kernel);
  add("store", store, profile, channels, 2, Crc::None, kernel);
  if (kernel == Kernel::Portable) add("crc", checksum, profile, channels, 1, Crc::Valid, kernel);
}

const bool kRegistered = []
{
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // as the program does: memory of scans that are gone is used again
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
  for (const OusterProfile& profile : kOusterProfiles)
  {
    for (const Kernel kernel : runnableKernels()) addProfile(profile, kernel);
    if (!isCommon(profile)) continue;
    for (const int sensors : {1, 2, 4, 8})
      add("order", merge<PointlessDecoder>, profile, profile.name == "LEGACY" ? 64 : 128, sensors, Crc::None,
          Kernel::Portable);
  }
  return true;
}();
}  // namespace
