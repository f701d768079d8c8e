#pragma once
#include "slam/ImuWatch.h"

#include <functional>
#include <optional>
#include <string>

namespace scanloom
{
/** Called with a message that the user should see at once. */
using Warn = std::function<void(const std::string&)>;

/** Compares the IMU in use with the motion that the lidars see, once a minute and at the end. Warns once. */
class ImuCheck
{
 public:
  /** `warn` must outlive the check. */
  ImuCheck(const Rigid& body_T_imu, const Warn& warn) : watch_(body_T_imu), warn_(warn) {}

  void add(const ImuSample& sample) { watch_.add(sample); }

  /** Runs the check if a minute has passed since the last one. */
  void add(const StateEstimate&);

  void check();

  /** The samples are another IMU's from here on. */
  void change(const Rigid& body_T_imu) { watch_ = ImuWatch(body_T_imu); }

  bool warned() const { return warned_; }

  /** As of the last check. */
  const std::optional<GyroAgreement>& agreement() const { return agreement_; }

 private:
  ImuWatch watch_;
  const Warn& warn_;
  std::optional<Timestamp> next_check_;
  std::optional<GyroAgreement> agreement_;
  bool warned_ = false;
};
}  // namespace scanloom
