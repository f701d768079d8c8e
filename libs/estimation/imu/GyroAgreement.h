/** Compares a gyroscope with another measurement of the same rigid body's rotation: both must agree in its frame. */
#pragma once
#include "base/core/ImuSample.h"
#include "base/core/Rigid.h"

#include <optional>
#include <vector>

namespace scanloom
{
struct PlacedGyro
{
  const std::vector<ImuSample>& samples;  // in the order of their stamps
  Rigid body_T_imu;
};

/** Rotation of the body from one instant to another: exp(rotation) is body(from)_R_body(to). */
struct BodyTurn
{
  Timestamp from, to;
  Eigen::Vector3d rotation;  // rad
};

struct GyroAgreement
{
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  // rad: exp(rotation) times b's rates are a's
  double sigma = 0;                                    // rad, standard deviation about the least certain axis
  double scale = 1;                                    // b's rates over a's
  double scale_sigma = 0;                              // standard deviation, with what noise adds to b's rates
  double unexplained = 0;                              // share of a's squared rates that b's, turned and scaled, leave
  bool mirrored = false;  // b's axes are left-handed: rotation turns its reversed rates to a's (a half turn: one axis)
  Duration lag{0};        // b's stamps are later than a's for the same instant
  double lag_sigma = 0;   // s, its standard deviation
};

/**
 * Least squares over the mean rates of the turns, without their constant part (the biases), at the lag with the best
 * correlation within +-0.5 s. None if fewer than 30 turns, or less than 5 s of turns, lie within b's samples and that
 * lag, half a second or more away from gaps of more than that, or if the body turned about one axis only or too little
 * for sigma < 5 deg.
 */
std::optional<GyroAgreement> gyroAgreement(const std::vector<BodyTurn>& a, const PlacedGyro& b);

/** With a's turns over 0.1 s each, gaps of more than 0.5 s left out. */
std::optional<GyroAgreement> gyroAgreement(const PlacedGyro& a, const PlacedGyro& b);
}  // namespace scanloom
