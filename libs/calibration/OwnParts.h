/** The parts of the machine that a lidar sees: they stay in place in its frame, and the body's, while it drives. */
#pragma once
#include "calibration/GroundPlane.h"

#include <cstdint>
#include <optional>
#include <unordered_map>

namespace scanloom
{
/** Cubes of 0.25 m that hold points at most places where the machine was. */
class OwnParts
{
 public:
  /** `reach`: m from the frame's origin. */
  OwnParts(const std::optional<GroundPlane>& ground, double reach) : ground_(ground), reach_(reach) {}

  /** Takes what was seen at another place than before. */
  void addPlace(const PointCloud&);

  /** Whether a point is within reach and farther than 0.4 m from the ground, which stays in place where it is flat. */
  bool mayHold(const Eigen::Vector3f&) const;

  /** Share of the places at which the point's cube held points. */
  double shareOfPlaces(const Eigen::Vector3f&) const;

  /** Whether the cube of a point that it may hold was not empty at three quarters of the places. */
  bool holds(const Eigen::Vector3f&) const;

 private:
  struct Cube
  {
    int places = 0, last = 0;
  };
  std::optional<GroundPlane> ground_;
  double reach_;
  int places_ = 0;
  std::unordered_map<std::uint64_t, Cube> cubes_;  // never iterated: its order is not defined
};
}  // namespace scanloom
