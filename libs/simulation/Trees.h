/** How a single tree looks: its stem, its branches and the envelope of its crown. */
#pragma once
#include "core/Field.h"
#include "simulation/Cone.h"
#include "simulation/Random.h"

#include <Eigen/Geometry>

#include <tuple>
#include <vector>

namespace scanloom
{
enum class Species
{
  Pine,
  Spruce,
  Birch,
};

struct TreeOptions
{
  double pine_share = 1;
  double spruce_share = 0;
  double diameter = 0.20;
  double diameter_spread = 0.05;
  double height = 19;
  double height_exponent = 0.35;
  double tilt_deg = 2;
  double crown_base = 0.55;
  double crown_radius = 0.09;
  int living_branches = 30;
  int dead_branches = 12;
  double dead_branch_base = 0.15;
  double branch_diameter = 0.03;
  double pine_branch_deg = 20;
  double spruce_branch_deg = -10;
  double birch_branch_deg = 45;
  double branch_spread_deg = 10;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.pine_share, Field{"pine_share", "", "of the stems (assumed)", between(0, 1)});
    visit(o.spruce_share, Field{"spruce_share", "", "of the stems; the rest are birches (assumed)", between(0, 1)});
    visit(o.diameter, Field{"diameter", "m", "mean diameter at breast height, 1.3 m", between(0.02, 2)});
    visit(o.diameter_spread, Field{"diameter_spread", "m", "standard deviation of the diameters", between(0, 1)});
    visit(o.height, Field{"height", "m", "of a tree of the mean diameter (assumed)", between(2, 50)});
    visit(o.height_exponent,
          Field{"height_exponent", "", "heights grow with this power of the diameter (assumed)", between(0, 2)});
    visit(o.tilt_deg, Field{"tilt_deg", "deg", "standard deviation of each stem's lean (assumed)", between(0, 20)});
    visit(o.crown_base, Field{"crown_base", "", "where the crown begins, share of the height", between(0, 0.95)});
    visit(o.crown_radius,
          Field{"crown_radius", "", "largest radius of the crown, share of the height (assumed)", between(0, 0.5)});
    visit(o.living_branches, Field{"living_branches", "", "of a tree (assumed)", between(0, 500)});
    visit(o.dead_branches, Field{"dead_branches", "", "of a tree, below its crown (assumed)", between(0, 500)});
    visit(o.dead_branch_base,
          Field{"dead_branch_base", "", "the lowest dead branch, share of the height (assumed)", between(0, 0.95)});
    visit(o.branch_diameter,
          Field{"branch_diameter", "m", "of the thickest branches of a mean tree (assumed)", between(0.002, 0.2)});
    visit(o.pine_branch_deg,
          Field{"pine_branch_deg", "deg", "living branches rise by so much (assumed)", between(-60, 80)});
    visit(o.spruce_branch_deg, Field{"spruce_branch_deg", "deg", "likewise (assumed)", between(-60, 80)});
    visit(o.birch_branch_deg, Field{"birch_branch_deg", "deg", "likewise (assumed)", between(-60, 80)});
    visit(o.branch_spread_deg,
          Field{"branch_spread_deg", "deg", "standard deviation of each branch's rise (assumed)", between(0, 30)});
  }
};

/** A row of the table of stems. A stem is a straight cone; what is below the foot is root. */
struct Stem
{
  Eigen::Vector3d foot;  // on the ground
  Eigen::Vector3d axis;  // unit, upwards
  double diameter = 0;   // m, at breast height: 1.3 m along the axis
  double length = 0;     // m, along the axis above the ground; of a class
  Species species = Species::Pine;
  double turn = 0;  // rad, of its branches about the axis

  Cone wood() const;

  /** Turns a vertical tree into this one. */
  Eigen::Quaterniond rotation() const;
};

/** A tree on `foot`; equal random numbers, equal trees. */
Stem growTree(const TreeOptions&, const Eigen::Vector3d& foot, Random&);

/** Radius of the crown of a tree of height 1 at a height between 0 and 1: 0 outside the crown. */
double crownRadius(const TreeOptions&, Species, double height);

/**
 * What trees with the same branches have in common. Lengths come in classes, so that a few looks serve a whole stand.
 */
struct TreeLook
{
  Species species;
  int length_class;
  int variant;

  bool operator<(const TreeLook& o) const
  {
    return std::tie(species, length_class, variant) < std::tie(o.species, o.length_class, o.variant);
  }
};
TreeLook lookOf(const Stem&);

/** The branches of a look on a vertical tree with its foot in the origin. */
std::vector<Cone> growBranches(const TreeOptions&, const TreeLook&);

/** A branch of a stem's look where it is in the world. */
Cone placeBranch(const Cone&, const Stem&);
}  // namespace scanloom
