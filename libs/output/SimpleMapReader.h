/** Keyframes back from a .simplemap: ours, or any whose observations are point clouds. */
#pragma once
#include "core/Keyframe.h"
#include "output/SimpleMapFile.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace mrpt::obs
{
class CObservationPointCloud;
}

namespace scanloom
{
class SimpleMapReader
{
 public:
  /**
   * Throws std::runtime_error with the path if it cannot be read, is damaged or holds no cloud; with the keyframe's
   * number, too, if a pose is none or farther than 1e6 m, or if a lidar (a label) moved on the body, which one origin
   * of rays per lidar cannot express.
   */
  explicit SimpleMapReader(const std::filesystem::path&);
  ~SimpleMapReader();

  /** By sensor id: labels in the order in which they first occur. */
  const std::vector<MountedLidar>& lidars() const { return lidars_; }
  std::size_t size() const;

  /** In the body frame, with intensity and sensor_id: a .simplemap of ours holds no more. Without points that are NaN.
   */
  Keyframe keyframe(std::size_t index) const;

 private:
  void addLidarOf(const mrpt::obs::CObservationPointCloud&);

  std::unique_ptr<mrpt::maps::CSimpleMap> map_;
  std::vector<Rigid> map_T_body_;
  std::vector<MountedLidar> lidars_;
};
}  // namespace scanloom
