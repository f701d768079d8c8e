#include "CloudMemory.h"

namespace scanloom
{
Array<float>& CloudMemory::positions()
{
  if (points_.x.empty()) return positions_;
  const float *x = points_.x.data(), *y = points_.y.data(), *z = points_.z.data();
  float* to = positions_.room(3 * size());
  for (std::size_t i = 0; i < size(); ++i)
  {
    to[3 * i] = x[i];
    to[3 * i + 1] = y[i];
    to[3 * i + 2] = z[i];
  }
  positions_.grow(3 * size());
  points_.x = points_.y = points_.z = {};
  return positions_;
}

PointCloud CloudMemory::copy() const
{
  PointCloud cloud = points_;
  if (positions_.empty()) return cloud;
  cloud.x.resize(size());
  cloud.y.resize(size());
  cloud.z.resize(size());
  for (std::size_t i = 0; i < size(); ++i)
  {
    cloud.x[i] = positions_[3 * i];
    cloud.y[i] = positions_[3 * i + 1];
    cloud.z[i] = positions_[3 * i + 2];
  }
  return cloud;
}
}  // namespace scanloom
