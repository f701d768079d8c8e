#include "mrpt/observations/Observations.h"
#include "mrpt/observations/RawlogReader.h"
#include "mrpt/observations/RawlogWriter.h"

#include <benchmark/benchmark.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <unistd.h>
#include <cmath>
#include <filesystem>

namespace scanloom
{
namespace
{
/** Two lidars of 128 beams, every second return valid: 131072 points on gently rolling ground. */
Scan fullScan()
{
  Scan scan;
  scan.period = 100ms;
  scan.points.resize(131072);
  for (std::size_t i = 0; i < scan.points.size(); i++)
  {
    const auto column = static_cast<double>(i / 64);
    const auto ring = static_cast<double>(i % 64);
    const double range = 3 + 0.2 * ring + 0.3 * std::sin(0.05 * column + ring);
    scan.points.x[i] = static_cast<float>(range * std::cos(2 * M_PI * column / 1024));
    scan.points.y[i] = static_cast<float>(range * std::sin(2 * M_PI * column / 1024));
    scan.points.z[i] = static_cast<float>(0.1 * std::sin(range));
    scan.points.intensity[i] = static_cast<float>((i * 37) % 97);
    scan.points.t[i] = static_cast<std::int32_t>(column * 48'000);
    scan.points.ring[i] = static_cast<std::uint16_t>(2 * (i % 64));
    scan.points.column[i] = static_cast<std::uint16_t>(i / 128);
    scan.points.sensor_id[i] = static_cast<std::uint8_t>(i / 64 % 2);
  }
  return scan;
}

std::filesystem::path scratchFile()
{
  return std::filesystem::temp_directory_path() / ("scanloom_benchmark_" + std::to_string(getpid()) + ".rawlog");
}

void makeObservation(benchmark::State& state)
{
  const Scan scan = fullScan();
  for ([[maybe_unused]] auto step : state) benchmark::DoNotOptimize(toObservation(scan));
}

void writeScan(benchmark::State& state)
{
  const Scan scan = fullScan();
  RawlogWriter writer(scratchFile(), {}, {static_cast<int>(state.range(0))});
  for ([[maybe_unused]] auto step : state) writer.write(*toObservation(scan));
  writer.close();
  state.counters["MB"] =
      1e-6 * static_cast<double>(std::filesystem::file_size(scratchFile())) / static_cast<double>(state.iterations());
  std::filesystem::remove(scratchFile());
}

/** The same objects by MRPT's own stream: zlib, in one thread. */
void writeScanByMrpt(benchmark::State& state)
{
  const Scan scan = fullScan();
  mrpt::io::CFileGZOutputStream file;
  if (!file.open(scratchFile().string(), static_cast<int>(state.range(0)))) return state.SkipWithError("no file");
  auto archive = mrpt::serialization::archiveFrom(file);
  for ([[maybe_unused]] auto step : state) archive << *toObservation(scan);
  file.close();
  state.counters["MB"] =
      1e-6 * static_cast<double>(std::filesystem::file_size(scratchFile())) / static_cast<double>(state.iterations());
  std::filesystem::remove(scratchFile());
}

void readScan(benchmark::State& state)
{
  const auto cloud = toObservation(fullScan());
  for ([[maybe_unused]] auto step : state) benchmark::DoNotOptimize(fromObservation(*cloud, std::nullopt));
}

BENCHMARK(makeObservation)->Unit(benchmark::kMillisecond);
BENCHMARK(writeScan)->ArgName("gzip")->Arg(0)->Arg(1)->MeasureProcessCPUTime()->UseRealTime()->Unit(
    benchmark::kMillisecond);
BENCHMARK(writeScanByMrpt)
    ->ArgName("gzip")
    ->Arg(0)
    ->Arg(1)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(readScan)->Unit(benchmark::kMillisecond);
}  // namespace
}  // namespace scanloom
