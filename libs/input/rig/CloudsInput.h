/** Scans from point clouds in files, one scan a file, of one lidar or of several that another program merged. */
#pragma once
#include "base/formats/CloudFile.h"
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
 * clouds. The lidar is called `clouds`; its frame is the body's. There is no IMU. A cloud that cannot be read, and one
 * that is not after the ones before, is left out with a warning, and counts as a damaged input.
 */
class CloudsInput : public SensorInput
{
 public:
  /** Throws as cloudTimes() does, and std::runtime_error if none of the clouds can be read. */
  explicit CloudsInput(std::vector<std::filesystem::path>);

  using SensorInput::next;
  std::optional<SensorEvent> next(Duration patience) override;
  bool ended() const override { return ended_; }
  void stop() override { stop_ = true; }
  SensorSetup setup() const override;
  double progress() const override;
  RigAccount account() const override;
  std::vector<std::string> takeWarnings() override;

 private:
  CloudFile firstReadable() const;
  Scan read(std::size_t cloud) const;

  std::vector<std::filesystem::path> clouds_;
  CloudTimes times_;
  Duration interval_;  // between two clouds: the median
  double unit_ = 1;    // s, of the points' times
  std::size_t next_ = 0;
  Timestamp last_end_ = Timestamp::min();
  std::vector<std::string> warnings_;  // until takeWarnings() gives them
  std::uint64_t left_out_ = 0;         // clouds
  bool ended_ = false;
  std::atomic<bool> stop_{false};
};
}  // namespace scanloom
