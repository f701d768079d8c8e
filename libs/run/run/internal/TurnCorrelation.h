#pragma once
#include "estimation/imu/GyroAgreement.h"

#include <optional>

namespace scanloom
{
/**
 * How far two gyroscopes of a rigid body measure the same turns: 1 if they do, about 0 if the stamps or the poses of
 * one are wrong. It is the correlation of their mean rates over 0.1 s, in the body's frame, without the constant part
 * (the biases). None if they share less than a second, or turn too little to tell.
 */
std::optional<double> turnCorrelation(const PlacedGyro&, const PlacedGyro&);
}  // namespace scanloom
