/** The results of `slam` for one drive, as a site is made of. */
#pragma once
#include "base/core/Keyframe.h"
#include "base/core/MountedLidar.h"
#include "base/core/StampedPose.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
class SimpleMapReader;

/** A keyframe without its points. */
struct DriveKeyframe
{
  Timestamp stamp;
  Rigid drive_T_body;
  Matrix6d covariance;  // of the pose in the map of the keyframes before it, tangent of boxPlus
  /** Which way is up, by the estimate at that time: gravity has levelled it, and not the keyframe's registration. */
  Eigen::Vector3d body_up;
  double up_sigma;     // rad, of roll and pitch
  bool begins_a_part;  // the body was lost before: the pose relative to the keyframe before is worth little
};

class SiteDrive
{
 public:
  /** `folder`: results of `slam`, run with maps. Throws std::runtime_error that says what is missing or damaged. */
  explicit SiteDrive(const std::filesystem::path& folder);
  ~SiteDrive();
  SiteDrive(SiteDrive&&) noexcept;

  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<MountedLidar>& lidars() const;
  const std::vector<DriveKeyframe>& keyframes() const { return keyframes_; }

  /** The body's poses in the drive's frame. */
  const Trajectory& trajectory() const { return trajectory_; }

  /** With its points, their sensor_ids by lidars(). */
  Keyframe keyframe(std::size_t index) const;

 private:
  std::filesystem::path folder_;
  std::unique_ptr<SimpleMapReader> reader_;
  std::vector<DriveKeyframe> keyframes_;
  Trajectory trajectory_;
};
}  // namespace scanloom
