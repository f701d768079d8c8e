/** Two gyroscopes on one rigid body: turned into its frame they must tell the same. */
#pragma once
#include "core/ImuSample.h"
#include "core/Rigid.h"

#include <optional>
#include <vector>

namespace scanloom
{
struct PlacedGyro
{
  const std::vector<ImuSample>& samples;
  Rigid body_T_imu;
};

struct GyroAgreement
{
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  // rad: exp(rotation) turns b's rates into a's
  double sigma = 0;                                    // rad, standard deviation of the worst known axis
  double scale = 1;                                    // of b's rates over a's
  Duration lag{0};                                     // b's stamps are late by this
};

/**
 * Least squares over means of 0.1 s less their constant part (the biases), at the lag of the best correlation, +-0.5 s.
 * None if they share less than 5 s, or if the body turned about one axis only or too little for sigma < 5 deg.
 */
std::optional<GyroAgreement> gyroAgreement(const PlacedGyro& a, const PlacedGyro& b);
}  // namespace scanloom
