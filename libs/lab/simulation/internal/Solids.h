/** Intersections of rays with boxes and cones, in closed form and double precision. */
#pragma once
#include "base/core/Rigid.h"
#include "lab/simulation/internal/Cone.h"
#include "lab/simulation/internal/Ray.h"

#include <Eigen/Geometry>

#include <optional>

namespace scanloom
{
/** Where a ray from outside meets a body. */
struct Contact
{
  double range = 0;
  double cosine_incidence = 0;  // 1 when it meets the surface at a right angle
};

std::optional<Contact> castBox(const Eigen::AlignedBox3d&, const Ray&);

/** A box of any orientation. */
class OrientedBox
{
 public:
  /** `half`: m from the centre to the faces. */
  OrientedBox(const Rigid& frame_T_box, const Eigen::Vector3d& half);

  std::optional<Contact> cast(const Ray&) const;  // the ray in the frame

  const Rigid& frameTBox() const { return frame_T_box_; }
  const Eigen::Vector3d& half() const { return half_; }

 private:
  Rigid frame_T_box_;
  Eigen::Matrix3d box_R_frame_;
  Eigen::Vector3d half_;
};

std::optional<Contact> castCone(const Cone&, const Ray&);
}  // namespace scanloom
