/** A single tree: its stem, its branches and the envelope of its crown. */
#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/Cone.h"
#include "lab/simulation/internal/Random.h"

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

/** The branches of a tree. */
struct BranchOptions
{
  int living_branches = 30;
  int dead_branches = 12;
  double branch_diameter = 0.03;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.living_branches,
          Field{"living_branches", "", "number of living branches of a tree (assumed)", between(0, 500)});
    visit(o.dead_branches,
          Field{"dead_branches", "", "number of dead branches of a tree, below its crown (assumed)", between(0, 500)});
    visit(o.branch_diameter, Field{"branch_diameter", "m", "diameter of the thickest branches of a mean tree (assumed)",
                                   between(0.002, 0.2)});
  }
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
  BranchOptions branches;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.pine_share, Field{"pine_share", "", "share of pines among the stems (assumed)", between(0, 1)});
    visit(o.spruce_share, Field{"spruce_share", "", "share of spruces; the rest are birches (assumed)", between(0, 1)});
    visit(o.diameter, Field{"diameter", "m", "mean diameter at breast height, 1.3 m", between(0.02, 2)});
    visit(o.diameter_spread, Field{"diameter_spread", "m", "standard deviation of the diameters", between(0, 1)});
    visit(o.height, Field{"height", "m", "height of a tree of the mean diameter (assumed)", between(2, 50)});
    visit(o.height_exponent,
          Field{"height_exponent", "", "heights grow with this power of the diameter (assumed)", between(0, 2)});
    visit(o.tilt_deg,
          Field{"tilt_deg", "deg", "standard deviation of a stem's tilt about each axis (assumed)", between(0, 20)});
    visit(o.crown_base, Field{"crown_base", "", "height at which the crown begins, as a share of the tree's height",
                              between(0, 0.95)});
    visit(o.crown_radius,
          Field{"crown_radius", "", "largest radius of the crown, as a share of the tree's height (assumed)",
                between(0, 0.5)});
    BranchOptions::fields(o.branches, visit);
  }
};

/** A straight stem with its foot on the ground. */
struct Stem
{
  Eigen::Vector3d foot;  // on the ground
  Eigen::Vector3d axis;  // unit, upwards
  double diameter = 0;   // m, at breast height: 1.3 m along the axis
  double length = 0;     // m, along the axis above the ground; one of the length classes
  Species species = Species::Pine;
  double turn = 0;  // rad, rotation of its branches about the axis

  Cone wood() const;

  /** Rotation of a vertical tree into this one. */
  Eigen::Quaterniond rotation() const;
};

/** A random tree that stands on `foot`. */
Stem growTree(const TreeOptions&, const Eigen::Vector3d& foot, Random&);

/** Radius of the crown of a tree of height 1 at `height`; 0 outside the crown. */
double crownRadius(const TreeOptions&, Species, double height);

/** Trees of the same look have the same branches. Lengths come in classes, so that a stand has only a few looks. */
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

/** The branches of a vertical tree whose foot is the origin. */
std::vector<Cone> growBranches(const TreeOptions&, const TreeLook&);

/** A branch of growBranches() on a stem in the world. */
Cone placeBranch(const Cone&, const Stem&);
}  // namespace scanloom
