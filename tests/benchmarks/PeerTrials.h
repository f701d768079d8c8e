/** Rows of ndt_peers_benchmark: a peer is registered by its own file, which is built only where its packages are. */
#pragma once
#include "base/core/Rigid.h"

#include <functional>
#include <string>
#include <vector>

namespace scanloom
{
using Points = std::vector<Eigen::Vector3f>;

/** target_T_source from a guess, with all preparation of the source: what is timed. */
using RegisterSource = std::function<Rigid(const Points& source, const Rigid& guess)>;

/** Prepares the target, which is not timed: an odometry has its map already. */
using PrepareTarget = std::function<RegisterSource(const Points& target)>;

/** Adds a row per pair of clouds. The value is for the initialiser of a constant, so that files can add their own. */
bool addPeer(const std::string& name, PrepareTarget);

/** Means of the points in cubes of 25 cm: what peers that look at single points are given (small_gicp's default). */
Points thinned(const Points&);
}  // namespace scanloom
