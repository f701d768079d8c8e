#include "lab/simulation/internal/Trees.h"

#include "base/core/Angle.h"
#include "base/core/So3.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
// Assumed.
constexpr double kDeadBranchBase = 0.15;  // height of the lowest dead branch, as a share of the tree's height
constexpr double kPineBranchDeg = 20;     // deg: elevation of a pine's living branches
constexpr double kSpruceBranchDeg = -10;  // deg: elevation of a spruce's living branches
constexpr double kBirchBranchDeg = 45;    // deg: elevation of a birch's living branches
constexpr double kBranchSpreadDeg = 10;   // deg: standard deviation of a branch's elevation

constexpr double kBreastHeight = 1.3;  // m
constexpr double kRootDepth = 0.5;     // m: stems begin this deep, below the ground on any slope
constexpr double kTipRadius = 0.004;   // m

constexpr double kShortestTree = 2.0;  // m: of length class 0
constexpr double kLengthRatio = 1.06;  // of a class to the next
constexpr int kVariants = 4;           // of trees of the same species and length class

double lengthOfClass(int length_class) { return kShortestTree * std::pow(kLengthRatio, length_class); }
int classOfLength(double length)
{
  return static_cast<int>(
      std::lround(std::log(std::max(length, kShortestTree) / kShortestTree) / std::log(kLengthRatio)));
}

/** Elevation of living branches, deg. */
double branchElevation(Species species)
{
  switch (species)
  {
    case Species::Pine:
      return kPineBranchDeg;
    case Species::Spruce:
      return kSpruceBranchDeg;
    case Species::Birch:
      return kBirchBranchDeg;
  }
  return 0;
}

Cone growBranch(double height, double length, double elevation_deg, double radius, Random& random)
{
  const double azimuth = random.uniform(0, 2 * M_PI);
  const double elevation = kDegree * elevation_deg;
  return {{0, 0, height},
          {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation), std::sin(elevation)},
          length,
          radius,
          0.3 * radius};
}
}  // namespace

Cone Stem::wood() const
{
  const double tip = std::min(kTipRadius, 0.25 * diameter);
  const double widening = (0.5 * diameter - tip) / (length - kBreastHeight);  // per metre downwards
  return {foot - kRootDepth * axis, axis, length + kRootDepth, tip + widening * (length + kRootDepth), tip};
}

Eigen::Quaterniond Stem::rotation() const
{
  return rotationBetween(Eigen::Vector3d::UnitZ(), axis) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
}

Stem growTree(const TreeOptions& options, const Eigen::Vector3d& foot, Random& random)
{
  Stem stem;
  stem.foot = foot;
  // Not drawn as arguments of the vector: their order is the compiler's choice.
  const double lean_y = random.normal(), lean_x = random.normal();
  const Eigen::Vector2d lean = kDegree * options.tilt_deg * Eigen::Vector2d(lean_x, lean_y);
  stem.axis = Eigen::Vector3d(lean.x(), lean.y(), 1).normalized();

  // Log-normal: positive, and skewed as diameters of young stands are.
  constexpr double kMostDeviations = 3.5;
  const double variance = std::log1p(std::pow(options.diameter_spread / options.diameter, 2));
  const double deviation = std::clamp(random.normal(), -kMostDeviations, kMostDeviations);
  const double share_of_mean = std::exp(std::sqrt(variance) * deviation - 0.5 * variance);
  stem.diameter = options.diameter * share_of_mean;
  const double length = options.height * std::pow(share_of_mean, options.height_exponent);
  stem.length = lengthOfClass(classOfLength(length));

  const double lot = random.uniform();
  stem.species = lot < options.pine_share                          ? Species::Pine
                 : lot < options.pine_share + options.spruce_share ? Species::Spruce
                                                                   : Species::Birch;
  stem.turn = random.uniform(0, 2 * M_PI);
  return stem;
}

double crownRadius(const TreeOptions& options, Species species, double height)
{
  const double v = (height - options.crown_base) / (1 - options.crown_base);
  if (v <= 0 || v >= 1) return 0;
  switch (species)
  {
    case Species::Pine:  // a dome
      return options.crown_radius * std::sqrt(1 - v * v) * std::min(1.0, 0.5 + 2 * v);
    case Species::Spruce:  // a cone
      return options.crown_radius * (1 - v);
    case Species::Birch:  // an ellipse
      return options.crown_radius * std::sqrt(4 * v * (1 - v));
  }
  return 0;
}

TreeLook lookOf(const Stem& stem)
{
  const int variant = static_cast<int>(stem.turn / (2 * M_PI) * 1024) % kVariants;
  return {stem.species, classOfLength(stem.length), variant};
}

std::vector<Cone> growBranches(const TreeOptions& options, const TreeLook& look)
{
  Random random(static_cast<std::uint64_t>(look.species), RandomStream::Branches,
                static_cast<std::uint64_t>(look.variant));
  const double tree = lengthOfClass(look.length_class);
  const double thickest = 0.5 * options.branches.branch_diameter * tree / options.height;
  std::vector<Cone> branches;
  for (int i = 0; i < options.branches.living_branches; ++i)
  {
    const double share = (i + random.uniform()) / options.branches.living_branches;
    const double height = options.crown_base + (1 - options.crown_base) * (0.02 + 0.93 * share);
    const double mean = branchElevation(look.species);
    const double length = crownRadius(options, look.species, height) / std::cos(kDegree * mean);
    const double elevation = mean + kBranchSpreadDeg * random.normal();
    if (length > 0)
      branches.push_back(growBranch(tree * height, tree * length, elevation, thickest * (1 - 0.7 * share), random));
  }
  for (int i = 0; i < options.branches.dead_branches && kDeadBranchBase < options.crown_base; ++i)
  {
    const double height = random.uniform(kDeadBranchBase, options.crown_base);
    const double length = options.crown_radius * random.uniform(0.1, 0.8);  // some are broken off
    const double elevation = kBranchSpreadDeg * random.normal();
    branches.push_back(growBranch(tree * height, tree * length, elevation, 0.6 * thickest, random));
  }
  return branches;
}

Cone placeBranch(const Cone& branch, const Stem& stem)
{
  const Eigen::Quaterniond turn = stem.rotation();
  return {stem.foot + turn * branch.base, turn * branch.axis, branch.length, branch.base_radius, branch.tip_radius};
}
}  // namespace scanloom
