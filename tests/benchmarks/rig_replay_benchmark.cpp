/**
 * From a capture to scans, as `record` and `slam` read them, beside the batcher alone with the same packets. The
 * capture is a turn of each lidar, read again and again, so that it is in the kernel's memory. One thread.
 *
 *   read/<sensors>     datagrams out of the file: libpcap, IP, UDP, one copy
 *   route/<sensors>    and whose they are: size, type, serial number, address, checksum (CRC-64, valid in all)
 *   replay/<sensors>   and scans out of them: RigReplay, the product's path
 *   batch/<sensors>    the same packets, already in memory and routed, through TimeBatcher: what the others are
 * compared with
 *
 * `us_per_packet` is processor time with page faults. OS-128, 1024x10, RNG19_RFL8_SIG16_NIR16: packets of 24.8 kB.
 */
#include "RigOfPackets.h"
#include "input/packets/CaptureReader.h"
#include "input/packets/CaptureWriter.h"
#include "input/rig/internal/RigReplay.h"
#include "support/pushPacket.h"

#include <benchmark/benchmark.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace scanloom::bench
{
namespace
{
constexpr int kTurns = 10;
constexpr std::uint16_t kFirstPort = 7502;

using Packets = Rig;

Packets packetsOf(int sensors)
{
  const auto profile = std::find_if(std::begin(kOusterProfiles), std::end(kOusterProfiles),
                                    [](const OusterProfile& p) { return p.name == "RNG19_RFL8_SIG16_NIR16"; });
  return {*profile, 128, sensors, Crc::Valid};
}

DatagramView datagramOf(std::size_t lidar, const Packet& packet, Timestamp received)
{
  DatagramView datagram;
  datagram.received = received;
  datagram.source = IpAddress::parse("10.0.0." + std::to_string(lidar + 1));
  datagram.destination_port = static_cast<std::uint16_t>(kFirstPort + lidar);
  datagram.payload = packet;
  return datagram;
}

/** A capture of ten turns, removed at the end. */
class SomeCapture
{
 public:
  explicit SomeCapture(int sensors)
  {
    Packets packets = packetsOf(sensors);
    CaptureWriter writer(path_);
    for (int turn = 0; turn < kTurns; ++turn, packets.advance())
      packets.forEachPacket([&](std::size_t lidar, const Packet& packet, Timestamp received)
                            { writer.write(datagramOf(lidar, packet, received)); });
    writer.close();
  }
  SomeCapture(const SomeCapture&) = delete;
  SomeCapture& operator=(const SomeCapture&) = delete;
  ~SomeCapture() { std::filesystem::remove(path_); }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("scanloom_benchmark_" + std::to_string(getpid()) + ".pcap");
};

scanloom::Rig rigOf(const SomeCapture& capture, int sensors)
{
  scanloom::Rig rig;
  rig.captures = {capture.path()};
  rig.lidars = packetsOf(sensors).lidars<OusterDecoder>(widestKernel());
  for (int i = 0; i < sensors; ++i)
  {
    LidarAddress address;
    address.lidar_port = static_cast<std::uint16_t>(kFirstPort + i);
    rig.addresses.push_back(address);
    rig.sensors.emplace_back();
  }
  return rig;
}

void keepFreedMemory()  // as the program does
{
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
}

void perPacket(benchmark::State& state)
{
  using benchmark::Counter;
  const double packets = static_cast<double>(state.range(0)) * kPacketsPerTurn * kTurns;
  state.counters["us_per_packet"] = Counter(1e-6 * packets, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void read(benchmark::State& state)
{
  const SomeCapture capture(static_cast<int>(state.range(0)));
  for (auto _ : state)
  {
    CaptureReader reader(capture.path());
    Datagram datagram;
    while (reader.next(datagram)) benchmark::DoNotOptimize(datagram.payload.data());
  }
  perPacket(state);
}

void route(benchmark::State& state)
{
  const int sensors = static_cast<int>(state.range(0));
  const SomeCapture capture(sensors);
  const scanloom::Rig rig = rigOf(capture, sensors);
  for (auto _ : state)
  {
    CaptureReader reader(capture.path());
    PacketRouter router(routesOf(rig));
    Datagram datagram;
    while (reader.next(datagram)) benchmark::DoNotOptimize(router.route(datagram));
  }
  perPacket(state);
}

void replay(benchmark::State& state)
{
  keepFreedMemory();
  const int sensors = static_cast<int>(state.range(0));
  const SomeCapture capture(sensors);
  const scanloom::Rig rig = rigOf(capture, sensors);
  std::size_t scans = 0;
  for (auto _ : state)
  {
    RigReplay replay(rig);
    scans = 0;
    while (const auto event = replay.next()) scans += std::holds_alternative<Scan>(*event);
  }
  if (scans < kTurns - 1) state.SkipWithError("scans are missing");
  perPacket(state);
}

void batch(benchmark::State& state)
{
  keepFreedMemory();
  Packets packets = packetsOf(static_cast<int>(state.range(0)));
  const auto lidars = packets.lidars<OusterDecoder>(widestKernel());
  for (auto _ : state)
  {
    TimeBatcher batcher(lidars, {});
    for (int turn = 0; turn < kTurns; ++turn)
    {
      packets.forEachPacket([&](std::size_t lidar, const Packet& packet, Timestamp received)
                            { benchmark::DoNotOptimize(push(batcher, lidar, packet, received)); });
      state.PauseTiming();
      packets.advance();
      state.ResumeTiming();
    }
  }
  perPacket(state);
}

BENCHMARK(read)->RangeMultiplier(2)->Range(1, 8)->Unit(benchmark::kMillisecond);
BENCHMARK(route)->RangeMultiplier(2)->Range(1, 8)->Unit(benchmark::kMillisecond);
BENCHMARK(replay)->RangeMultiplier(2)->Range(1, 8)->Unit(benchmark::kMillisecond);
BENCHMARK(batch)->RangeMultiplier(2)->Range(1, 8)->Unit(benchmark::kMillisecond);
}  // namespace
}  // namespace scanloom::bench
