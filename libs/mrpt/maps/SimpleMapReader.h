/** Keyframes of a .simplemap, written by us or by others, whose observations are point clouds. */
#pragma once
#include "base/core/Keyframe.h"
#include "mrpt/maps/SimpleMapFile.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace mrpt::obs
{
class CObservationPointCloud;
}

namespace scanloom
{
/** By its name: .simplemap, or .simplemap.gz. */
bool isSimpleMap(const std::filesystem::path&);

class SimpleMapReader
{
 public:
  /**
   * Throws std::runtime_error with the path if it cannot be read, is damaged or has no cloud; also with the keyframe's
   * number if a pose is no rigid motion or farther than 1e8 m, or if a lidar's pose on the body changes (lidars are
   * distinguished by their labels).
   */
  explicit SimpleMapReader(const std::filesystem::path&);
  ~SimpleMapReader();

  /** By sensor id: labels in the order in which they first occur. */
  const std::vector<MountedLidar>& lidars() const { return lidars_; }
  std::size_t size() const;

  /** Points in the body frame with intensity and sensor_id; other fields are 0. Points with NaN are left out. */
  Keyframe keyframe(std::size_t index) const;

  const Rigid& pose(std::size_t index) const { return map_T_body_.at(index); }

  /** Of boxMinus(truth, map_T_body), as in MeasuredKeyframe; 0 where it is not known. */
  Matrix6d covariance(std::size_t index) const;

 private:
  void addLidarOf(const mrpt::obs::CObservationPointCloud&);

  std::unique_ptr<mrpt::maps::CSimpleMap> map_;
  std::vector<Rigid> map_T_body_;
  std::vector<MountedLidar> lidars_;
};
}  // namespace scanloom
