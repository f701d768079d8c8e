/** Rays per second through the stands of params/simulation/, and what an hour's world takes. */
#include "ForestScans.h"

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

namespace scanloom
{
namespace
{
constexpr double kMaxRange = 50;
constexpr int kBeams = 128;

/** Every second column of an OS0-128: 128 beams over 90 degrees, 2.5 m above the ground, upright. */
std::vector<Ray> fan(const World& world, double x)
{
  std::vector<Ray> rays;
  const Eigen::Vector3d origin(x, 0, world.ground().height(x, 0.0) + 2.5);
  for (int column = 0; column < 1024; column += 2)
    for (int beam = 0; beam < kBeams; ++beam)
    {
      const double azimuth = 2 * M_PI * column / 1024, altitude = M_PI / 4 * (1 - beam / 63.5);
      rays.push_back(
          {origin,
           {std::cos(azimuth) * std::cos(altitude), std::sin(azimuth) * std::cos(altitude), std::sin(altitude)}});
    }
  return rays;
}

/** A world and rays in it that all threads of a benchmark share. */
struct Course
{
  explicit Course(const std::string& stand) : world(standAround(stand, 20, 1))
  {
    for (const double x : {5.0, 10.0, 15.0})
      for (const Ray& ray : fan(world, x)) rays.push_back(ray);
  }

  World world;
  std::vector<Ray> rays;
};

const Course& courseThrough(std::string_view stand)
{
  static const Course sparse("sparse"), dense("dense");
  return stand == "sparse" ? sparse : dense;
}

void castRays(benchmark::State& state, const std::string& stand)
{
  const Course& course = courseThrough(stand);
  std::array<double, 8> returns{};
  double rays = 0;
  std::uint64_t draw = static_cast<std::uint64_t>(state.thread_index()) << 32;
  std::vector<RayQuery> column(kBeams);
  for (auto _ : state)
    for (auto first = course.rays.begin(); first != course.rays.end(); first += kBeams)
    {
      std::transform(first, first + kBeams, column.begin(),
                     [&](const Ray& ray) {
                       return RayQuery{ray, kMaxRange, ++draw};
                     });
      for (const auto& hit : course.world.cast(column))
        if (hit) ++returns[static_cast<std::size_t>(hit->surface)];
      rays += kBeams;
    }
  state.SetItemsProcessed(static_cast<std::int64_t>(rays));
  constexpr std::array kNames{"ground", "stem", "branch", "crown", "undergrowth"};
  for (std::size_t i = 0; i < kNames.size(); ++i)
    state.counters[kNames[i]] = benchmark::Counter(returns[i] / rays, benchmark::Counter::kAvgThreads);
}
BENCHMARK_CAPTURE(castRays, sparse, "sparse")->ThreadRange(1, 2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(castRays, dense, "dense")->ThreadRange(1, 2)->UseRealTime()->Unit(benchmark::kMillisecond);

void castGround(benchmark::State& state)
{
  const Course& course = courseThrough("sparse");
  for (auto _ : state)
    for (const Ray& ray : course.rays) benchmark::DoNotOptimize(course.world.ground().intersect(ray, kMaxRange));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(course.rays.size()));
}
BENCHMARK(castGround)->Unit(benchmark::kMillisecond);

void castWood(benchmark::State& state, const std::string& stand)
{
  const Course& course = courseThrough(stand);
  for (auto _ : state)
    for (const Ray& ray : course.rays) benchmark::DoNotOptimize(course.world.wood().cast(ray, kMaxRange));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(course.rays.size()));
}
BENCHMARK_CAPTURE(castWood, sparse, "sparse")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(castWood, dense, "dense")->Unit(benchmark::kMillisecond);

void castFoliage(benchmark::State& state, const std::string& stand)
{
  const Course& course = courseThrough(stand);
  Random random(1, RandomStream::Leaves, 0);
  std::vector<FoliageQuery> column(kBeams);
  for (auto _ : state)
    for (auto first = course.rays.begin(); first != course.rays.end(); first += kBeams)
    {
      std::transform(first, first + kBeams, column.begin(),
                     [&](const Ray& ray) {
                       return FoliageQuery{ray, kMaxRange, random.exponential()};
                     });
      benchmark::DoNotOptimize(course.world.foliage().intersect(column));
    }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(course.rays.size()));
}
BENCHMARK_CAPTURE(castFoliage, sparse, "sparse")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(castFoliage, dense, "dense")->Unit(benchmark::kMillisecond);

/** Memory of this process, MiB. */
double residentMemory()
{
  std::ifstream statm("/proc/self/statm");
  double total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/** The world around 1 km of path. */
void grow(benchmark::State& state, const std::string& stand)
{
  for (auto _ : state)
  {
    const double before = residentMemory();
    const World world = standAround(stand, 1000, 1);
    state.counters["stems"] = static_cast<double>(world.stems().size());
    state.counters["MiB"] = residentMemory() - before;
  }
}
BENCHMARK_CAPTURE(grow, sparse, "sparse")->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(grow, dense, "dense")->Unit(benchmark::kMillisecond)->Iterations(1);
}  // namespace
}  // namespace scanloom
