/** One point of the machine over time: what a total station measures of its prism, and where a trajectory has it. */
#pragma once
#include "core/StampedPose.h"

#include <Eigen/Core>

#include <filesystem>
#include <stdexcept>
#include <vector>

namespace scanloom
{
struct StampedPosition
{
  Timestamp stamp;
  Eigen::Vector3d position;  // m
};

/** Stamps rise strictly. */
using PositionTrack = std::vector<StampedPosition>;

/**
 * Lines of `t,x,y,z` in seconds and metres; further columns, comments (#), a header and empty lines are skipped. What
 * else is no measurement, and stamps that do not rise, throw std::invalid_argument with file and line.
 */
PositionTrack readTotalStation(const std::filesystem::path&);

/** Of a point that is fixed to the body. */
PositionTrack positionsOf(const Trajectory&, const Eigen::Vector3d& body_p_point = Eigen::Vector3d::Zero());

/** To be thrown: names the times of both. */
std::invalid_argument shareNoTime(const PositionTrack& estimate, const PositionTrack& reference);

/** The same instant by both. */
struct PositionPair
{
  Timestamp stamp;
  Eigen::Vector3d map_p;        // by the estimate
  Eigen::Vector3d reference_p;  // by the reference
};

/**
 * Where the estimate, interpolated to the reference's stamps, has a point of the body. Left out are stamps that it does
 * not cover, and those between two of its poses more than 2 s apart: a chord over a longer gap says nothing about the
 * estimate.
 */
std::vector<PositionPair> pairsAtReference(const Trajectory& estimate, const Eigen::Vector3d& body_p_point,
                                           const PositionTrack& reference);
}  // namespace scanloom
