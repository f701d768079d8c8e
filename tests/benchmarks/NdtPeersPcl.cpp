/**
 * PCL's registrations: NDT with the cells, step and iterations of PCL's tutorial, GICP with the reach of 1 m and the 10
 * neighbours that small_gicp has by default.
 */
#include "benchmarks/PeerTrials.h"

#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/ndt.h>

#include <memory>

namespace scanloom
{
namespace
{
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr thinCloudOf(const Points& points)
{
  const auto cloud = pcl::make_shared<Cloud>();
  for (const Eigen::Vector3f& p : thinned(points)) cloud->push_back({p.x(), p.y(), p.z()});
  return cloud;
}

/** All of the target go into PCL's cells; its source is taken point by point, and so thinned. */
Cloud::Ptr cloudOf(const Points& points)
{
  const auto cloud = pcl::make_shared<Cloud>();
  for (const Eigen::Vector3f& p : points) cloud->push_back({p.x(), p.y(), p.z()});
  return cloud;
}

/** A float matrix is a rotation only to 1e-6. */
Rigid rigidOf(const Eigen::Matrix4f& m)
{
  return {Eigen::Quaterniond(Eigen::Matrix3d(m.topLeftCorner<3, 3>().cast<double>())).normalized(),
          m.topRightCorner<3, 1>().cast<double>()};
}

template <typename Registration>
RegisterSource byPcl(const std::shared_ptr<Registration>& registration)
{
  return [registration](const Points& source, const Rigid& guess)
  {
    Cloud aligned;
    registration->setInputSource(thinCloudOf(source));
    registration->align(aligned, guess.matrix().cast<float>());
    return rigidOf(registration->getFinalTransformation());
  };
}

RegisterSource ndt(const Points& target)
{
  const auto registration = std::make_shared<pcl::NormalDistributionsTransform<pcl::PointXYZ, pcl::PointXYZ>>();
  registration->setTransformationEpsilon(1e-6);  // m^2: the tutorial's 0.01 ends after one step, which is 0.1 m at most
  registration->setStepSize(0.1);
  registration->setResolution(1.0);
  registration->setMaximumIterations(35);
  registration->setInputTarget(cloudOf(target));
  return byPcl(registration);
}

RegisterSource gicp(const Points& target)
{
  const auto registration = std::make_shared<pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ>>();
  registration->setCorrespondenceRandomness(10);
  registration->setMaxCorrespondenceDistance(1.0);
  registration->setInputTarget(thinCloudOf(target));
  return byPcl(registration);
}

[[maybe_unused]] const bool kAdded = addPeer("pcl_ndt", ndt) && addPeer("pcl_gicp", gicp);
}  // namespace
}  // namespace scanloom
