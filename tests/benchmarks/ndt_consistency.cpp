/**
 * Registers pairs of scans in simulated stands from guesses that are off, and compares the errors with the covariances
 * that came with them. NEES = e' information e; its mean over many pairs is 6 where the covariances are right.
 */
#include "base/core/Angle.h"
#include "base/core/Statistics.h"
#include "benchmarks/ForestScans.h"
#include "benchmarks/NeesHistogram.h"
#include "estimation/ndt/Registration.h"
#include "estimation/ndt/briefOf.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <random>

namespace scanloom
{
namespace
{
struct Arguments
{
  std::string stand = "sparse";
  int pairs = 40;
  double baseline = 1;  // m from scan to scan along the lane
  std::vector<double> target_cells{8, 4, 2, 0.5}, source_cells{8, 4, 2, 1};
  ForestLidar lidar;
  double spread = 0.2, spread_deg = 2;  // of each guess from the truth, exactly, in a random direction
  NdtOptions cells;
  RegistrationOptions alignment;
  std::string write_pairs;
};

struct Pair
{
  std::vector<Eigen::Vector3f> target, source;
  Rigid target_T_source;
};

Pair pairAt(int index, const Arguments& arguments)
{
  const auto number = static_cast<std::uint64_t>(index);
  Random random(number, RandomStream::Stand, 77);
  const auto tilt = [&]
  { return Eigen::Vector3d(random.uniform(-M_PI, M_PI), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)); };
  const World world = standAround(arguments.stand, 12, 1 + number);
  const Eigen::Vector3d first = tilt(), turn(random.uniform(-0.2, 0.2), random.uniform(-0.05, 0.05), 0);
  const Rigid target = poseInStand(world, 5, first), source = poseInStand(world, 5 + arguments.baseline, first + turn);
  return {forestScan(world, target, arguments.lidar, 2 * number),
          forestScan(world, source, arguments.lidar, 2 * number + 1), target.inverse() * source};
}

struct Registered
{
  RegistrationResult result;
  Vector6d error;
  double nees;
};

Registered registered(const Pair& pair, const Rigid& guess, const Arguments& arguments)
{
  const auto target = ndtLevels(pair.target, arguments.target_cells, arguments.cells);
  const auto source = ndtLevels(pair.source, arguments.source_cells, arguments.cells);
  Registered done;
  done.result = alignCoarseToFine(pairLevels(target, source), guess, arguments.alignment);
  done.error = boxMinus(pair.target_T_source, done.result.target_T_source);
  done.nees = done.error.dot(done.result.information * done.error);
  return done;
}

/** As KITTI does: four floats per point, the last one its intensity. */
void writeBin(const std::filesystem::path& path, const std::vector<Eigen::Vector3f>& points)
{
  std::ofstream file(path, std::ios::binary);
  for (const Eigen::Vector3f& p : points)
  {
    const std::array<float, 4> record{p.x(), p.y(), p.z(), 0};
    file.write(reinterpret_cast<const char*>(record.data()), sizeof record);
  }
}

void writePair(const Pair& pair, const std::filesystem::path& folder, int index)
{
  const auto path = [&](const char* what) { return folder / fmt::format("{:03d}_{}", index, what); };
  writeBin(path("target.bin"), pair.target);
  writeBin(path("source.bin"), pair.source);
  std::ofstream(path("truth.txt")) << std::setprecision(17) << pair.target_T_source.matrix() << '\n';
}

using Generator = std::mt19937_64;

/** In [0, 1), from the generator's bits: the standard's distributions differ between libraries. */
double uniform(Generator& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

Eigen::Vector3d direction(Generator& random)
{
  const double z = 2 * uniform(random) - 1, azimuth = 2 * M_PI * uniform(random);
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

Rigid guessNear(const Rigid& truth, int seed, const Arguments& arguments)
{
  Generator random(static_cast<std::uint64_t>(seed));
  Vector6d step;
  step.head<3>() = arguments.spread * direction(random);
  step.tail<3>() = arguments.spread_deg * kDegree * direction(random);
  return truth * boxPlus(Rigid::identity(), step);
}

void run(const Arguments& arguments)
{
  std::vector<double> metres, degrees, nees;
  Vector6d squares = Vector6d::Zero(), whitened = Vector6d::Zero(), mean = Vector6d::Zero();
  int untrusted = 0;
  for (int i = 0; i < arguments.pairs; ++i)
  {
    const Pair pair = pairAt(i, arguments);
    if (!arguments.write_pairs.empty()) writePair(pair, arguments.write_pairs, i);
    const Registered r = registered(pair, guessNear(pair.target_T_source, i, arguments), arguments);
    if (!r.result.trustworthy()) ++untrusted;
    if (r.error.head<3>().norm() > 0.1 || r.error.tail<3>().norm() > kDegree)
    {
      fmt::print("pair {}: {:.3f} m {:.2f} deg off, {}\n", i, r.error.head<3>().norm(),
                 r.error.tail<3>().norm() / kDegree, briefOf(r.result));
      continue;
    }
    metres.push_back(r.error.head<3>().norm());
    degrees.push_back(r.error.tail<3>().norm() / kDegree);
    nees.push_back(r.nees);
    squares += r.error.cwiseAbs2();
    mean += r.error;
    whitened += r.error.cwiseAbs2().cwiseQuotient(r.result.covariance.diagonal());
  }
  if (nees.empty())
  {
    fmt::print("none of {} pairs found\n", arguments.pairs);
    return;
  }
  const auto n = static_cast<double>(nees.size());
  for (auto* values : {&metres, &degrees}) std::sort(values->begin(), values->end());
  fmt::print(
      "{} pairs, {:.1f} m apart, {}: {:.0f} % found, {} not trusted; median {:.1f} mm {:.3f} deg, worst {:.1f} mm "
      "{:.3f} deg\n",
      arguments.pairs, arguments.baseline, arguments.stand, 100 * n / arguments.pairs, untrusted,
      1000 * quantileOfSorted(metres, 0.5), quantileOfSorted(degrees, 0.5), 1000 * metres.back(), degrees.back());
  const Vector6d rms = (squares / n).cwiseSqrt(), bias = mean / n, ratio = (whitened / n);
  fmt::print("RMS x y z {:.1f} {:.1f} {:.1f} mm, about x y z {:.3f} {:.3f} {:.3f} deg; mean {:.1f} {:.1f} {:.1f} mm\n",
             1000 * rms[0], 1000 * rms[1], 1000 * rms[2], rms[3] / kDegree, rms[4] / kDegree, rms[5] / kDegree,
             1000 * bias[0], 1000 * bias[1], 1000 * bias[2]);
  fmt::print("squared error by variance, x y z: {:.2f} {:.2f} {:.2f}, about them: {:.2f} {:.2f} {:.2f}\n", ratio[0],
             ratio[1], ratio[2], ratio[3], ratio[4], ratio[5]);
  std::sort(nees.begin(), nees.end());
  double sum = 0;
  for (const double v : nees) sum += v;
  fmt::print("mean NEES {:.2f}, median {:.2f} (of chi squared, 6: 6, 5.35)\n", sum / n, quantileOfSorted(nees, 0.5));
  printHistogram(nees, 6);
}
}  // namespace
}  // namespace scanloom

int main(int argc, char** argv)
{
  scanloom::Arguments a;
  CLI::App app{"Errors of registrations beside their covariances, over pairs of scans in simulated stands"};
  app.add_option("--stand", a.stand, "sparse or dense")->capture_default_str();
  app.add_option("--pairs", a.pairs, "each in a stand of its own")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--baseline", a.baseline, "m from scan to scan")->capture_default_str();
  app.add_option("--target-cells", a.target_cells, "m, coarse ones first")->expected(1, -1)->capture_default_str();
  app.add_option("--source-cells", a.source_cells, "as many")->expected(1, -1)->capture_default_str();
  app.add_option("--beams", a.lidar.beams)->capture_default_str();
  app.add_option("--columns", a.lidar.columns)->capture_default_str();
  app.add_option("--min-deviation", a.cells.min_deviation, "m")->capture_default_str();
  app.add_option("--min-points", a.cells.min_points)->capture_default_str();
  app.add_option("--d2", a.alignment.d2)->capture_default_str();
  app.add_option("--neighbours", a.alignment.neighbours, "of a cell: 1, 7 or 27")->capture_default_str();
  app.add_option("--spread-m", a.spread, "how far each guess is off")->capture_default_str();
  app.add_option("--spread-deg", a.spread_deg, "how far it is turned")->capture_default_str();
  app.add_option("--write-pairs", a.write_pairs, "an existing folder for the clouds and their truths")
      ->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  if (a.target_cells.size() != a.source_cells.size())
  {
    std::cerr << "--source-cells: as many as --target-cells\n";
    return 2;
  }
  scanloom::run(a);
}
