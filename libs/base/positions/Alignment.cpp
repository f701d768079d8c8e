#include "base/positions/Alignment.h"

#include "base/core/Decompositions.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace scanloom
{
namespace
{
struct PairMoments
{
  Eigen::Vector3d map_mean = Eigen::Vector3d::Zero(), reference_mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();   // reference by map
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  // of the reference
};

PairMoments momentsOf(const std::vector<PositionPair>& pairs)
{
  const double share = 1 / static_cast<double>(pairs.size());
  PairMoments m;
  for (const PositionPair& pair : pairs)
  {
    m.map_mean += share * pair.map_p;
    m.reference_mean += share * pair.reference_p;
  }
  for (const PositionPair& pair : pairs)
  {
    const Eigen::Vector3d reference = pair.reference_p - m.reference_mean;
    m.cross += share * reference * (pair.map_p - m.map_mean).transpose();
    m.spread += share * reference * reference.transpose();
  }
  return m;
}

Eigen::Quaterniond yawOf(const PairMoments& m)
{
  const double yaw = std::atan2(m.cross(1, 0) - m.cross(0, 1), m.cross(0, 0) + m.cross(1, 1));
  return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

Eigen::Quaterniond rotationOf(const PairMoments& m)
{
  return Eigen::Quaterniond(rotationOfLargestTrace(m.cross).rotation);
}
}  // namespace

Alignment align(const std::vector<PositionPair>& pairs, AlignmentKind kind)
{
  if (pairs.empty()) throw std::invalid_argument("align: no pairs of positions");
  const PairMoments m = momentsOf(pairs);

  Alignment alignment;
  alignment.reference_T_map.rotation = kind == AlignmentKind::Yaw ? yawOf(m) : rotationOf(m);
  alignment.reference_T_map.translation = m.reference_mean - alignment.reference_T_map.rotation * m.map_mean;
  if (kind == AlignmentKind::Yaw)
  {
    alignment.lever = std::sqrt(m.spread(0, 0) + m.spread(1, 1));
    return alignment;
  }
  const Eigen::Vector3d variances = eigensystem3(m.spread).values.cwiseMax(0.0);  // ascending
  const double worst = variances(0) + variances(1), best = variances(1) + variances(2);
  alignment.lever = std::sqrt(worst);
  alignment.condition = worst > 0 ? best / worst : std::numeric_limits<double>::infinity();
  return alignment;
}
}  // namespace scanloom
