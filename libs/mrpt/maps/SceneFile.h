/** MRPT's 3D scene of points and paths, for windows, pictures and .3Dscene files. */
#pragma once
#include "base/core/Keyframe.h"
#include "base/formats/Trajectory.h"
#include "mrpt/maps/MrptScene.h"

#include <Eigen/Core>

#include <filesystem>
#include <vector>

namespace octomap
{
class OcTree;
}

namespace scanloom
{
class SceneBuilder
{
 public:
  void addPoints(const std::vector<Eigen::Vector3f>&);  // those that are finite
  void addKeyframe(const Keyframe&);
  void addOccupied(const octomap::OcTree&);  // the voxels' centres, kMostListedVoxels at most
  void addPath(const Trajectory&);

  /**
   * Points coloured by height, paths as lines, a grid of 10 m (or a power of ten more) below, and a camera that sees
   * all of it. Throws std::invalid_argument if there are neither points nor poses.
   */
  MrptScene::Ptr finished() const;

 private:
  std::vector<Eigen::Vector3f> points_;
  std::vector<Trajectory> paths_;
};

/** gzipped; opens in SceneViewer3D. Throws std::runtime_error if it cannot be written. */
void writeScene(const std::filesystem::path&, const MrptScene&);

/** Draws without a display. Throws std::runtime_error if it cannot be drawn or written. */
void writePicture(const std::filesystem::path&, const MrptScene&, int width, int height);
}  // namespace scanloom
