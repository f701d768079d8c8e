/** MRPT's ICP as it is set by default, but for its reach: the default of 0.75 m and 0.15 deg is below our guesses. */
#include "benchmarks/PeerTrials.h"

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/slam/CICP.h>

namespace scanloom
{
namespace
{
mrpt::maps::CSimplePointsMap::Ptr mapOf(const Points& points)
{
  const auto map = mrpt::maps::CSimplePointsMap::Create();
  for (const Eigen::Vector3f& p : thinned(points)) map->insertPoint(p.x(), p.y(), p.z());
  return map;
}

mrpt::poses::CPose3DPDFGaussian guessOf(const Rigid& pose)
{
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Vector3d angles = pose.yawPitchRoll();
  return mrpt::poses::CPose3DPDFGaussian({t.x(), t.y(), t.z(), angles[0], angles[1], angles[2]});
}

Rigid rigidOf(const mrpt::poses::CPose3D& pose)
{
  return Rigid::fromXyzYawPitchRoll(pose.x(), pose.y(), pose.z(), pose.yaw(), pose.pitch(), pose.roll());
}

RegisterSource icp(const Points& target)
{
  mrpt::slam::CICP::TConfigParams options;
  options.thresholdDist = 1;
  options.thresholdAng = 5 * M_PI / 180;
  return [map = mapOf(target), options](const Points& source, const Rigid& guess)
  {
    const auto scan = mapOf(source);
    return rigidOf(mrpt::slam::CICP(options).Align3DPDF(map.get(), scan.get(), guessOf(guess))->getMeanVal());
  };
}

[[maybe_unused]] const bool kAdded = addPeer("mrpt_icp", icp);
}  // namespace
}  // namespace scanloom
