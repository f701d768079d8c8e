/** Arrays of numpy as values of C++. Each throws UsageError with the argument's name if its shape is another. */
#pragma once
#include "base/core/Rigid.h"

#include <pybind11/numpy.h>

#include <cstdint>
#include <vector>

namespace scanloom
{
/** (N, 3) */
std::vector<Eigen::Vector3f> pointsIn(const pybind11::handle&, const char* name);

/** (3,) */
Eigen::Vector3d vectorIn(const pybind11::handle&, const char* name);

/** (4, 4), a rotation and a translation. */
Rigid poseIn(const pybind11::handle&, const char* name);

/** (N,), of any type of integers; empty for None. */
std::vector<std::int64_t> integersIn(const pybind11::handle&, const char* name);
}  // namespace scanloom
