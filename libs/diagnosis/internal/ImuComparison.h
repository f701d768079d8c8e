/** The IMUs of one body beside each other: all must turn alike in its frame. */
#pragma once
#include "base/core/Finding.h"
#include "diagnosis/internal/FindingLimits.h"
#include "estimation/imu/GyroAgreement.h"

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct BodyImu
{
  std::string name;
  const std::vector<ImuSample>& samples;  // in the order of their stamps
  Rigid body_T_imu;
};

/** An IMU beside another one. */
struct ImuComparison
{
  std::size_t imu = 0, reference = 0;
  Eigen::Quaterniond body_R_imu = Eigen::Quaterniond::Identity();  // of the one that is compared
  std::optional<GyroAgreement> agreement;                          // none: the body turned too little
  bool outvoted = false;  // most others agree with the reference; of two that differ nobody knows
};

/**
 * All but one beside that one, the reference: the first with which most others agree, or, where there is none such, the
 * first. So it does not matter which IMU is the first.
 */
std::vector<ImuComparison> compareImus(const std::vector<BodyImu>&);

/** Differences of turn rates that matter, where they are also beyond four standard deviations. */
struct TurnLimits
{
  double scale = limits::kGyroScaleWarning;
  double angle_deg = limits::kGyroAngleNotFitDeg;
  double lag_ms = limits::kImuLagWarningMs;
};

/** About the IMU that is compared, `name`. */
Finding turnsFinding(const ImuComparison&, const std::string& name, const std::string& reference,
                     const TurnLimits& = {});
}  // namespace scanloom
