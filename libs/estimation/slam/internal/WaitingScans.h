/** The scans that localisation uses, while they wait for the start and for the IMU. */
#pragma once
#include "estimation/imu/ImuBuffer.h"
#include "input/batching/Scan.h"

#include <cstdint>
#include <deque>
#include <optional>

namespace scanloom
{
class WaitingScans
{
 public:
  /** Every `every_nth` scan is used; one waits for the IMU until a scan has ended that is `imu_wait` later. */
  WaitingScans(int every_nth, Duration imu_wait) : every_nth_(every_nth), imu_wait_(imu_wait) {}

  /** Counts the scan; false if it is to be left out. */
  bool wants(const Scan&);

  /** A scan that is wanted, without the machine's points: the first ones wait for seconds. */
  void add(Scan);

  /** No scan waits for the IMU any longer. */
  void endInput() { input_ended_ = true; }

  /** The oldest scan need not wait for the IMU, or no longer. */
  bool isReady(const ImuBuffer&) const;

  /** The oldest. */
  Scan take();

  const std::deque<Scan>& scans() const { return scans_; }
  bool inputEnded() const { return input_ended_; }
  std::uint64_t skipped() const { return skipped_; }

 private:
  bool isCutStart(const Scan&);

  std::uint64_t every_nth_;
  Duration imu_wait_;
  std::deque<Scan> scans_;
  std::optional<Timestamp> first_start_;  // of incomplete scans before the first that was added
  std::optional<Timestamp> last_end_;     // of those that were added
  std::uint64_t seen_ = 0, skipped_ = 0;
  bool input_ended_ = false;
};
}  // namespace scanloom
