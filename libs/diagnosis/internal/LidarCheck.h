#pragma once
#include "base/core/Keyframe.h"
#include "base/core/MountedLidar.h"
#include "calibration/GroundPlane.h"
#include "diagnosis/internal/EvenSelection.h"
#include "diagnosis/internal/PoseFinding.h"
#include "diagnosis/internal/SelfReturns.h"
#include "input/batching/Scan.h"

#include <memory>
#include <utility>
#include <vector>

namespace scanloom
{
/**
 * Whether the lidars' poses in the body fit what they see, by the last eight keyframes: what each lidar sees must stay
 * in place while the machine drives, and be where the first lidar sees it at the same keyframe or its neighbours.
 * Before there are eight, it must also be where the first lidar sees it in the same scans, up to twelve from the whole
 * drive as `doctor` takes them. Before there are three, a lidar is also named if its ground is tilted and is not the
 * ground that another lidar sees: lidars that contradict each other so much keep a run from making keyframes. A ground
 * that all see alike may be a slope. With two lidars exchanged both are named.
 */
class LidarCheck
{
 public:
  /** `lidars` by sensor id. */
  explicit LidarCheck(std::vector<MountedLidar> lidars) : lidars_(std::move(lidars)) {}

  void add(const Keyframe&);

  /** In the order of time. */
  void add(const Scan&);

  /** In the order of the lidars; without steadiness before there are three keyframes. */
  Findings compare() const;

  /** What of the machine is in the keyframes, and so in the map. */
  Finding crop() const;

 private:
  using PointsByLidar = std::vector<PointCloud>;

  struct Seen
  {
    Rigid map_T_body;
    PointsByLidar points;  // in the body frame
  };

  /** Of each lidar but the first. */
  Findings posesByScans() const;
  Findings compareBeforeKeyframes() const;
  Finding poseBy(std::size_t lidar, const std::vector<SeenPoints>& own, const std::vector<SeenPoints>& by_first) const;
  std::vector<SeenPoints> seenInScans(std::size_t lidar) const;
  Findings compareGrounds() const;
  std::vector<const PointCloud*> cloudsOf(std::size_t lidar) const;
  std::optional<GroundPlane> groundOf(std::size_t lidar) const;
  bool staysBehind(const std::vector<SelfReturns>&, double size) const;

  /** By keyframe, in its body frame. */
  std::vector<SeenPoints> seenBy(std::size_t lidar) const;

  /** The same together with what its neighbours saw. */
  std::vector<SeenPoints> seenAround(std::size_t lidar, bool with_itself) const;

  std::vector<MountedLidar> lidars_;
  std::vector<std::shared_ptr<const Seen>> keyframes_;  // a copy of the check shares them
  EvenSelection<std::shared_ptr<const PointsByLidar>> scans_;
  std::int64_t scans_seen_ = 0;
};
}  // namespace scanloom
