/** Positions of one point of the machine over time: of the prism by a total station, or from a trajectory. */
#pragma once
#include "base/core/StampedPose.h"

#include <Eigen/Core>

#include <stdexcept>
#include <string>
#include <vector>

namespace scanloom
{
struct StampedPosition
{
  Timestamp stamp;
  Eigen::Vector3d position;  // m
  double sigma = 0;          // m, of each coordinate; 0: not said
  std::string name{};        // of a control point; empty: none
};

/** With strictly increasing stamps. */
using PositionTrack = std::vector<StampedPosition>;

/** Positions of a point that is fixed to the body. */
PositionTrack positionsOf(const Trajectory&, const Eigen::Vector3d& body_p_point = Eigen::Vector3d::Zero());

/** To be thrown; its message has the times of both. */
std::invalid_argument shareNoTime(const PositionTrack& estimate, const PositionTrack& reference);

/** Two positions of the same point at the same time. */
struct PositionPair
{
  Timestamp stamp;
  Eigen::Vector3d map_p;        // by the estimate
  Eigen::Vector3d reference_p;  // by the reference
};

/**
 * Positions of a point of the body by the estimate, interpolated to the reference's stamps. Stamps outside of its time
 * are left out, and so are those between two poses more than 2 s apart: interpolation there says nothing about the
 * estimate.
 */
std::vector<PositionPair> pairsAtReference(const Trajectory& estimate, const Eigen::Vector3d& body_p_point,
                                           const PositionTrack& reference);

/**
 * Share of the reference's time, 0 to 1, at which there is an estimate: the intervals between samples of the reference
 * that have a pair of pairsAtReference() at both ends.
 */
double coverage(const std::vector<PositionPair>&, const PositionTrack& reference);
}  // namespace scanloom
