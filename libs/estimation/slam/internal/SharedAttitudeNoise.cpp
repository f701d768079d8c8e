#include "estimation/slam/internal/SharedAttitudeNoise.h"

#include "base/core/Angle.h"
#include "estimation/ndt/FittedConstants.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
void SharedAttitudeNoise::add(const RegistrationResult& seen, const Eigen::Vector3d& up_in_source,
                              const Eigen::Vector3d& map_begin, double travel)
{
  const Eigen::Vector3d back =
      seen.target_T_source.rotation.conjugate() * (map_begin - seen.target_T_source.translation);
  length_ = std::max(back.norm(), fitted::kSightLength);
  const Eigen::Vector3d across = up_in_source.cross(back);
  if (!(across.norm() > 0)) return;
  sideways_ += std::min(1.0, travel / length_) * (across.normalized().dot(seen.viewpoint_bias) - sideways_);
}

double SharedAttitudeNoise::heading() const { return length_ > 0 ? std::abs(sideways_) / length_ : 0; }

Matrix6d SharedAttitudeNoise::covariance(const Eigen::Vector3d& up_in_source) const
{
  const Eigen::Matrix3d about_up = up_in_source * up_in_source.transpose();
  Matrix6d covariance = Matrix6d::Zero();
  covariance.bottomRightCorner<3, 3>() =
      std::pow(heading(), 2) * about_up +
      std::pow(fitted::kSharedTiltDeg * kDegree, 2) * (Eigen::Matrix3d::Identity() - about_up);
  return covariance;
}
}  // namespace scanloom
