#include "estimation/ndt/internal/ScoreSums.h"
#include "estimation/ndt/internal/PairInformation.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace scanloom::score_sums_unittest
{
namespace
{
/** Source cells against none to four blocks of random targets, near and far. */
struct Pairs
{
  std::vector<TurnedCell> cells;
  std::vector<BlockRange> ranges;
  std::vector<TargetBlock> blocks;
};

Eigen::Matrix3d matrixOf(double xx, double xy, double xz, double yy, double yz, double zz)
{
  return (Eigen::Matrix3d() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
}

constexpr double kD2 = 0.05;

/** B of a pair, by the formula of doc/registration.md. */
Eigen::Matrix3d inverseOfBoth(const TurnedCell& s, const TargetBlock& t, std::size_t k)
{
  Eigen::Matrix3d both =
      matrixOf(s.xx, s.xy, s.xz, s.yy, s.yz, s.zz) + matrixOf(t.xx[k], t.xy[k], t.xz[k], t.yy[k], t.yz[k], t.zz[k]);
  both(2, 2) += 4 * kD2 * (s.zz - t.zz[k]) * (s.zz - t.zz[k]) / (s.zz + t.zz[k]);
  return both.inverse();
}

Pairs randomPairs()
{
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const auto covariance = [&]
  {
    Eigen::Matrix3d root;
    for (double& entry : root.reshaped()) entry = 0.3 * normal(random);
    return Eigen::Matrix3d(root * root.transpose() + 1e-3 * Eigen::Matrix3d::Identity());
  };
  Pairs pairs;
  for (std::uint32_t i = 0; i < 100; ++i)
  {
    const Eigen::Matrix3d c = covariance();
    pairs.cells.push_back(
        {normal(random), normal(random), normal(random), c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)});
    pairs.ranges.push_back({static_cast<std::uint32_t>(pairs.blocks.size()), i % 5});
    for (std::uint32_t block = 0; block < i % 5; ++block)
    {
      TargetBlock b;
      for (std::size_t lane = 0; lane < TargetBlock::kLanes; ++lane)
      {
        const double spread = lane == 7 ? 1e9 : std::pow(3.0, static_cast<double>(lane) - 4);
        b.x[lane] = spread * normal(random), b.y[lane] = spread * normal(random), b.z[lane] = spread * normal(random);
        const Eigen::Matrix3d t = covariance();
        b.xx[lane] = t(0, 0), b.xy[lane] = t(0, 1), b.xz[lane] = t(0, 2);
        b.yy[lane] = t(1, 1), b.yz[lane] = t(1, 2), b.zz[lane] = t(2, 2);
      }
      pairs.blocks.push_back(b);
    }
  }
  return pairs;
}

std::vector<ScoreSums> sumsOf(const Pairs& pairs, Kernel kernel)
{
  std::vector<ScoreSums> sums(pairs.cells.size());
  sumPairs({pairs.cells.data(), pairs.ranges.data(), pairs.cells.size(), pairs.blocks.data()}, 0.05, sums.data(),
           kernel);
  return sums;
}
}  // namespace

TEST(ScoreSums, areTheSameBitsForEveryKernel)
{
  const Pairs pairs = randomPairs();
  const auto portable = sumsOf(pairs, Kernel::Portable);
  for (const Kernel kernel : runnableKernels())
  {
    const auto sums = sumsOf(pairs, kernel);
    EXPECT_EQ(std::memcmp(sums.data(), portable.data(), sums.size() * sizeof(ScoreSums)), 0) << nameOf(kernel);
  }
}

TEST(ScoreSums, areThoseOfTheFormulaPairByPair)
{
  const Pairs pairs = randomPairs();
  const auto sums = sumsOf(pairs, widestKernel());
  for (std::size_t i = 0; i < pairs.cells.size(); ++i)
  {
    const TurnedCell& s = pairs.cells[i];
    double score = 0, best = 0;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    Eigen::Matrix3d weight = Eigen::Matrix3d::Zero();
    for (std::uint32_t block = 0; block < pairs.ranges[i].count; ++block)
      for (std::size_t k = 0; k < TargetBlock::kLanes; ++k)
      {
        const TargetBlock& t = pairs.blocks[pairs.ranges[i].first + block];
        const Eigen::Vector3d m = Eigen::Vector3d(s.x, s.y, s.z) - Eigen::Vector3d(t.x[k], t.y[k], t.z[k]);
        const Eigen::Matrix3d b = inverseOfBoth(s, t, k);
        const double e = std::exp(-0.025 * m.dot(b * m));
        score += e;
        best = std::max(best, e);
        force += 0.05 * e * b * m;
        weight += 0.05 * e * b;
      }
    EXPECT_NEAR(sums[i].score, score, 1e-10 * (1 + score));
    EXPECT_NEAR(sums[i].best, best, 1e-10);
    EXPECT_LT((Eigen::Vector3d(sums[i].fx, sums[i].fy, sums[i].fz) - force).norm(), 1e-10 * (1 + force.norm()));
    EXPECT_LT((matrixOf(sums[i].xx, sums[i].xy, sums[i].xz, sums[i].yy, sums[i].yz, sums[i].zz) - weight).norm(),
              1e-10 * (1 + weight.norm()));
  }
}

std::vector<SymmetricBlock> randomStructures(std::size_t count)
{
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> entry(-0.5, 1);
  std::vector<SymmetricBlock> blocks(count);
  for (SymmetricBlock& b : blocks)
    for (double* values : {b.xx, b.xy, b.xz, b.yy, b.yz, b.zz})
      for (std::size_t lane = 0; lane < TargetBlock::kLanes; ++lane) values[lane] = entry(random);
  return blocks;
}

std::vector<PairInformation> evidenceOf(const Pairs& pairs, const std::vector<SymmetricBlock>& structures,
                                        Kernel kernel)
{
  std::vector<PairInformation> evidence(pairs.cells.size());
  gatherPairs({pairs.cells.data(), pairs.ranges.data(), pairs.cells.size(), pairs.blocks.data()}, structures.data(),
              0.05, evidence.data(), kernel);
  return evidence;
}

TEST(PairInformation, isTheSameBitsForEveryKernel)
{
  const Pairs pairs = randomPairs();
  const auto structures = randomStructures(pairs.blocks.size());
  const auto portable = evidenceOf(pairs, structures, Kernel::Portable);
  for (const Kernel kernel : runnableKernels())
  {
    const auto evidence = evidenceOf(pairs, structures, kernel);
    EXPECT_EQ(std::memcmp(evidence.data(), portable.data(), evidence.size() * sizeof(PairInformation)), 0)
        << nameOf(kernel);
  }
}

TEST(PairInformation, isThatOfTheFormulaPairByPair)
{
  const Pairs pairs = randomPairs();
  const auto structures = randomStructures(pairs.blocks.size());
  const auto evidence = evidenceOf(pairs, structures, widestKernel());
  for (std::size_t i = 0; i < pairs.cells.size(); ++i)
  {
    const TurnedCell& s = pairs.cells[i];
    Eigen::Matrix3d weight = Eigen::Matrix3d::Zero(), structured = weight, pull = weight;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (std::uint32_t block = 0; block < pairs.ranges[i].count; ++block)
      for (std::size_t k = 0; k < TargetBlock::kLanes; ++k)
      {
        const TargetBlock& t = pairs.blocks[pairs.ranges[i].first + block];
        const SymmetricBlock& x = structures[pairs.ranges[i].first + block];
        const Eigen::Matrix3d thin = matrixOf(x.xx[k], x.xy[k], x.xz[k], x.yy[k], x.yz[k], x.zz[k]);
        const Eigen::Vector3d m = Eigen::Vector3d(s.x, s.y, s.z) - Eigen::Vector3d(t.x[k], t.y[k], t.z[k]);
        const Eigen::Matrix3d b = inverseOfBoth(s, t, k);
        const double w = 0.05 * std::exp(-0.025 * m.dot(b * m));
        force += w * b * m;
        weight += w * b;
        structured += w * thin * b * thin;
        pull += w * (b - 0.05 * b * m * m.transpose() * b);
      }
    const auto expectNear = [](const auto& a, const auto& b) { EXPECT_LT((a - b).norm(), 1e-9 * (1 + b.norm())); };
    expectNear(Eigen::Vector3d(evidence[i].fx, evidence[i].fy, evidence[i].fz), force);
    expectNear(matrixOf(evidence[i].weight), weight);
    expectNear(matrixOf(evidence[i].structured), structured);
    expectNear(matrixOf(evidence[i].pull), pull);
  }
}
}  // namespace scanloom::score_sums_unittest
