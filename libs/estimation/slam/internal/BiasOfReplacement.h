/** The biases of an IMU that replaces another one of the same body. */
#pragma once
#include "base/core/ImuSample.h"
#include "estimation/imu/NavState.h"

#include <optional>
#include <vector>

namespace scanloom
{
/**
 * The biases of IMU `other` by IMU `known` of the same rigid body, from the means over the time that both have samples:
 * turn rates are the same everywhere in the body; specific forces differ by w x (w x r) and by dw/dt x r, whose mean
 * follows from the rates at both ends. None if they share less than a second. Samples in time order.
 */
std::optional<ImuBias> biasOfReplacement(const std::vector<ImuSample>& known, const ImuBias& known_bias,
                                         const std::vector<ImuSample>& other, const Rigid& known_T_other);
}  // namespace scanloom
