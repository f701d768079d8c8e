/**
 * Registration of a scan beside that of other libraries, from the same guesses and on one thread. Rows are
 * <pair>/<method>; a turn prepares the source and aligns it from the next guess. Medians over the guesses are in `ms`,
 * `error_mm`, `error_deg`; `success` is the share within 0.1 m and 1 deg.
 */
#include "base/core/Angle.h"
#include "base/core/Statistics.h"
#include "benchmarks/FullScan.h"
#include "benchmarks/PeerTrials.h"
#include "estimation/ndt/Registration.h"
#include "support/PointFile.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tsl/robin_map.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>
#include <random>

namespace scanloom
{
namespace
{
constexpr int kGuesses = 20;
constexpr double kMetresOff = 0.5, kDegreesOff = 5;

struct Pair
{
  Points target, source;
  Rigid target_T_source;
};

const Pair& simulatedPair()
{
  static const Pair pair{fullScan(Rigid::identity(), 1), fullScan(fullScanMotion(), 11), fullScanMotion()};
  return pair;
}

std::optional<std::filesystem::path> smallGicpFolder()
{
  const char* root = std::getenv("SCANLOOM_DATA");
  if (!root) return std::nullopt;
  const auto folder = std::filesystem::path(root) / "registration/koide3+small_gicp/data";
  return std::filesystem::exists(folder) ? std::optional(folder) : std::nullopt;
}

Rigid readTransform(const std::filesystem::path& path)
{
  std::ifstream file(path);
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  for (int i = 0; i < 12; ++i) file >> m(i / 4, i % 4);
  return Rigid::fromMatrix(m);
}

const Pair& smallGicpPair()
{
  static const auto folder = smallGicpFolder().value();
  static const Pair pair{readPly(folder / "target.ply"), readPly(folder / "source.ply"),
                         readTransform(folder / "T_target_source.txt")};
  return pair;
}

Eigen::Vector3d uniformDirection(std::mt19937_64& random)
{
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return Eigen::Vector3d(x, y, z).normalized();
}

/** The same ones for every method. */
std::vector<Rigid> guessesAround(const Rigid& truth)
{
  std::mt19937_64 random(1);
  std::vector<Rigid> guesses;
  for (int i = 0; i < kGuesses; ++i)
  {
    Vector6d step;
    step.head<3>() = kMetresOff * uniformDirection(random);
    step.tail<3>() = kDegreesOff * kDegree * uniformDirection(random);
    guesses.push_back(boxPlus(truth, step));
  }
  return guesses;
}

struct Trials
{
  std::vector<double> ms, error_mm, error_deg;

  void add(double took_ms, const Rigid& estimate, const Rigid& truth)
  {
    const Vector6d error = boxMinus(estimate, truth);
    ms.push_back(took_ms);
    error_mm.push_back(1000 * error.head<3>().norm());
    error_deg.push_back(error.tail<3>().norm() / kDegree);
  }

  double success() const
  {
    int successes = 0;
    for (std::size_t i = 0; i < ms.size(); ++i) successes += error_mm[i] < 100 && error_deg[i] < 1;
    return successes / static_cast<double>(ms.size());
  }
};

void registerFromGuesses(benchmark::State& state, const Pair& pair, const PrepareTarget& prepareTarget)
{
  using Clock = std::chrono::steady_clock;
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const auto guesses = guessesAround(pair.target_T_source);
  const RegisterSource registerSource = prepareTarget(pair.target);
  registerSource(pair.source, pair.target_T_source);  // some libraries prepare the target when it is first needed

  Trials trials;
  auto guess = guesses.begin();
  for (auto _ : state)
  {
    const auto start = Clock::now();
    const Rigid estimate = registerSource(pair.source, *guess++);
    const auto took = Clock::now() - start;
    trials.add(std::chrono::duration<double, std::milli>(took).count(), estimate, pair.target_T_source);
  }
  state.counters["ms"] = upperMedian(trials.ms);
  state.counters["error_mm"] = upperMedian(trials.error_mm);
  state.counters["error_deg"] = upperMedian(trials.error_deg);
  state.counters["success"] = trials.success();
}

void addRow(const std::string& name, const Pair& (*pair)(), const PrepareTarget& prepare)
{
  benchmark::RegisterBenchmark(
      name.c_str(), [pair, prepare](benchmark::State& state) { registerFromGuesses(state, pair(), prepare); })
      ->Iterations(kGuesses)
      ->Unit(benchmark::kMillisecond);
}

NdtMap mapOf(const Points& points, double cell_size)
{
  NdtOptions options;
  options.cell_size = cell_size;
  return NdtMap(points, options);
}

RegisterSource roughly(const Points& target)
{
  return [map = std::make_shared<NdtMap>(mapOf(target, 1.0))](const Points& source, const Rigid& guess)
  { return align(*map, mapOf(source, 2.5), guess, {}).target_T_source; };
}

/** As `scanloom register` does without a configuration. */
RegisterSource coarseToFine(const Points& target)
{
  const std::vector<double> cells{8, 4, 2, 0.5}, source_cells{8, 4, 2, 1};
  return [source_cells, targets = std::make_shared<std::vector<NdtMap>>(ndtLevels(target, cells, {}))](
             const Points& source, const Rigid& guess)
  { return alignCoarseToFine(pairLevels(*targets, ndtLevels(source, source_cells, {})), guess, {}).target_T_source; };
}

[[maybe_unused]] const bool kOursAreAdded =
    addPeer("scanloom_rough", roughly) && addPeer("scanloom_register", coarseToFine);
}  // namespace

bool addPeer(const std::string& name, PrepareTarget prepare)
{
  addRow("simulated/" + name, simulatedPair, prepare);
  if (smallGicpFolder()) addRow("small_gicp/" + name, smallGicpPair, prepare);
  return true;
}

Points thinned(const Points& points)
{
  struct Sum
  {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    float points = 0;
  };
  constexpr float kCube = 0.25f;
  constexpr std::uint64_t kOrigin = 1 << 20, kBits = 21;
  tsl::robin_map<std::uint64_t, std::size_t> cube_of_key;
  std::vector<Sum> cubes;  // in the order of their first points
  for (const Eigen::Vector3f& point : points)
  {
    std::uint64_t key = 0;
    for (const float x : {point.x(), point.y(), point.z()})
      key = key << kBits | (kOrigin + static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / kCube))));
    const auto [found, is_new] = cube_of_key.try_emplace(key, cubes.size());
    if (is_new) cubes.emplace_back();
    Sum& cube = cubes[found->second];
    cube.sum += point;
    ++cube.points;
  }
  Points means;
  for (const Sum& cube : cubes) means.push_back(cube.sum / cube.points);
  return means;
}
}  // namespace scanloom
