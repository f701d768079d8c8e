/** What is worth looking at in the points of two lidars: a stem and a strip of ground that both see. */
#pragma once
#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace scanloom
{
using Points3 = std::vector<Eigen::Vector3f>;  // m, z up

/** Upright and thin: seen by both, and little around it. */
struct SeenStem
{
  Eigen::Vector2f centre;
  float ground = 0;      // m, height of the ground there
  std::size_t seen = 0;  // points of the lidar that sees less of it
};

/** Heights above ground of the slice that shows a stem (m). */
inline constexpr float kSliceBottom = 1.0F, kSliceTop = 1.6F;

/** The one that both see best; none if none has ten points of each. */
std::optional<SeenStem> bestStem(const Points3& reference, const Points3& lidar);

/** A strip along x (0) or y (1), from `from` to `from` + 10 m, and 0.6 m wide; the plane through it as height above. */
struct GroundStrip
{
  int axis = 0;
  float from = 0, across = 0;
  Eigen::Vector3f plane{0, 0, 0};  // z = plane . (x, y, 1)
  std::size_t seen = 0;  // points of the lidar that sees less, summed over pieces of 0.5 m, 10 at most of each

  bool contains(const Eigen::Vector3f&) const;
  float height(const Eigen::Vector3f&) const;  // m, above the plane
};

inline constexpr float kStripLength = 10, kStripWidth = 0.6F;

/** The one that both see best; none if none has thirty points of each. */
std::optional<GroundStrip> bestGroundStrip(const Points3& reference, const Points3& lidar);
}  // namespace scanloom
