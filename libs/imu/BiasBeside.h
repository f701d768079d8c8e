/** The biases of one IMU from another one on the same body. */
#pragma once
#include "core/ImuSample.h"
#include "imu/NavState.h"

#include <optional>
#include <vector>

namespace scanloom
{
/**
 * Of `other`, from what both read over the time that both have: turn rates of a rigid body are the same everywhere, and
 * specific forces differ by w x (w x r) and by dw/dt x r, whose mean is what the rate changed. Nothing if they share
 * less than a second. Both in time order.
 */
std::optional<ImuBias> biasBeside(const std::vector<ImuSample>& known, const ImuBias& known_bias,
                                  const std::vector<ImuSample>& other, const Rigid& known_T_other);
}  // namespace scanloom
