/** Scans from point clouds in files, one scan a file, of one lidar or of several that another program merged. */
#pragma once
#include "input/rig/SensorInput.h"
#include "input/rig/internal/CloudTimes.h"

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * The clouds in the given order. Points with times are columns of equal time. Times of less than 1e8 s count from the
 * cloud's stamp, others are absolute; their unit (s, ms, us, ns) is that in which the first cloud spans at most 2 s. A
 * cloud without times is one column, taken at its stamp, which is the scan's end: so poses have the stamps of the
 * clouds. The lidar is called `clouds`; its frame is the body's. There is no IMU.
 */
class CloudsInput : public SensorInput
{
 public:
  /** Throws as cloudTimes() does, and std::runtime_error if the first cloud cannot be read. */
  explicit CloudsInput(std::vector<std::filesystem::path>);

  using SensorInput::next;
  /** Throws std::runtime_error for a cloud that cannot be read or whose times are not after those of the one before. */
  std::optional<SensorEvent> next(Duration patience) override;
  bool ended() const override { return ended_; }
  void stop() override { stop_ = true; }
  SensorSetup setup() const override;
  double progress() const override;
  RigAccount account() const override;
  std::vector<std::string> takeWarnings() override;

 private:
  Scan read(std::size_t cloud) const;

  std::vector<std::filesystem::path> clouds_;
  CloudTimes times_;
  Duration interval_;  // between two clouds: the median
  double unit_ = 1;    // s, of the points' times
  std::size_t next_ = 0;
  Timestamp last_end_ = Timestamp::min();
  std::string note_;  // until takeWarnings() gives it
  bool ended_ = false;
  std::atomic<bool> stop_{false};
};
}  // namespace scanloom
