/** Positions of a point of the machine that others have measured: by them a site comes into their frame. */
#pragma once
#include "base/positions/PositionTrack.h"
#include "site/SiteDrive.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace scanloom
{
/** How well positions are known, and for how long they err alike. */
struct ReferenceNoise
{
  double sigma;      // m, of each coordinate, where the file says none
  Duration lasting;  // positions within so much time count as one
};

/** A prism on a moving machine: its instrument is better, but not its clock and the mount. */
constexpr ReferenceNoise kTotalStationNoise{0.01, Duration{0}};

/** GNSS under a canopy, without corrections; what leaves reflect lasts for half a minute (assumed). */
constexpr ReferenceNoise kGnssNoise{2, 30s};

/** A track of a prism or an antenna, through one drive or several. z is up. */
struct Reference
{
  PositionTrack track;
  Eigen::Vector3d body_p_point = Eigen::Vector3d::Zero();
  ReferenceNoise noise = kTotalStationNoise;
};

/** A position of a reference, as the keyframe before it sees the point. */
struct ReferencePosition
{
  Timestamp stamp;
  std::size_t keyframe = 0;  // numbered through all drives
  Eigen::Vector3d keyframe_p_point;
  Eigen::Vector3d measured;                            // in the reference's frame
  double sigma = 0;                                    // m
  std::string name{};                                  // of a control point; empty: none
  double share = 1;                                    // that it counts
  bool used = false;                                   // it agrees with the others and the drives
  Eigen::Vector3d residual = Eigen::Vector3d::Zero();  // m, the site's position of the point less the measured one
};
}  // namespace scanloom
