#include "mrpt/edit/internal/ThinClouds.h"

#include "estimation/preprocessing/Thin.h"
#include "mrpt/edit/CloudObservation.h"

namespace scanloom
{
namespace
{
/** One mark per point. thin() returns points, so each carries its index in t, which thinning does not use. */
std::vector<std::uint8_t> firstOfEachCube(const std::vector<Eigen::Vector3f>& positions, double edge)
{
  PointCloud numbered;
  numbered.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    numbered.x[i] = positions[i].x();
    numbered.y[i] = positions[i].y();
    numbered.z[i] = positions[i].z();
    numbered.t[i] = static_cast<std::int32_t>(i);
  }
  std::vector<std::uint8_t> keep(positions.size());
  for (const std::int32_t number : thin(std::move(numbered), edge).t) keep[static_cast<std::size_t>(number)] = 1;
  return keep;
}
}  // namespace

RawlogOperation thinClouds(double edge)
{
  return keepingPoints([edge](const mrpt::obs::CObservationPointCloud& cloud)
                       { return firstOfEachCube(positionsInBody(cloud), edge); });
}
}  // namespace scanloom
