/** A gyroscope on a rigid body against whatever else tells how the body turned: in its frame both must tell the same.
 */
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

/** How the body turned from one instant to another: exp(rotation) is body(from)_R_body(to). */
struct BodyTurn
{
  Timestamp from, to;
  Eigen::Vector3d rotation;  // rad
};

struct GyroAgreement
{
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  // rad: exp(rotation) turns b's rates into a's
  double sigma = 0;                                    // rad, standard deviation of the worst known axis
  double scale = 1;                                    // of b's rates over a's
  Duration lag{0};                                     // b's stamps are late by this
  double lag_sigma = 0;                                // s, its standard deviation
};

/**
 * Least squares over the turns' mean rates less their constant part (the biases), at the lag of the best correlation,
 * +-0.5 s. None if fewer than 30 turns or less than 5 s of them lie within b's samples and that lag, or if the body
 * turned about one axis only or too little for sigma < 5 deg.
 */
std::optional<GyroAgreement> gyroAgreement(const std::vector<BodyTurn>& a, const PlacedGyro& b);

/** Of a's turns over 0.1 s each. */
std::optional<GyroAgreement> gyroAgreement(const PlacedGyro& a, const PlacedGyro& b);
}  // namespace scanloom
