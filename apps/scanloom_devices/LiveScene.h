#pragma once
#include "base/core/Bytes.h"

#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace scanloom
{
/** MRPT's 3D scene of the messages of a LiveMap. */
class LiveScene
{
 public:
  LiveScene();

  const mrpt::opengl::COpenGLScene::Ptr& scene() const { return scene_; }

  /** Of the machine, m, map frame. */
  const Eigen::Vector3f& position() const { return position_; }

  /** What LiveMap::lackedBy() gave. Throws std::out_of_range for a cut message. */
  void apply(Bytes messages);

 private:
  void addMap(Bytes message);
  void showScan(Bytes message);
  void extendPath(Bytes message);

  mrpt::opengl::COpenGLScene::Ptr scene_;
  std::vector<mrpt::opengl::CPointCloudColoured::Ptr> map_;  // one for each message: what is there is not drawn anew
  mrpt::opengl::CPointCloudColoured::Ptr scan_;
  mrpt::opengl::CSetOfLines::Ptr path_;
  mrpt::opengl::CRenderizable::Ptr body_;
  std::uint32_t map_epoch_ = 0, path_epoch_ = 0;
  Eigen::Vector3f position_ = Eigen::Vector3f::Zero(), path_end_ = Eigen::Vector3f::Zero();
  bool path_continues_ = false;
};
}  // namespace scanloom
