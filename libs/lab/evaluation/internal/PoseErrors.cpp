#include "lab/evaluation/internal/PoseErrors.h"

#include "base/formats/Trajectory.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanloom
{
namespace
{
constexpr double kDegrees = 180 / M_PI;

ErrorSize sizeOf(const std::vector<double>& errors)
{
  ErrorSize size;
  double squares = 0;
  for (const double error : errors)
  {
    squares += error * error;
    size.largest = std::max(size.largest, std::abs(error));
  }
  if (!errors.empty()) size.rmse = std::sqrt(squares / static_cast<double>(errors.size()));
  return size;
}

PoseErrors errorsOf(const std::vector<Rigid>& differences)
{
  std::vector<double> metres, degrees;
  for (const Rigid& difference : differences)
  {
    metres.push_back(difference.translation.norm());
    degrees.push_back(kDegrees * logSo3(difference.rotation).norm());
  }
  return {sizeOf(metres), sizeOf(degrees), differences.size()};
}

std::vector<PositionPair> positionsOf(const std::vector<PosePair>& pairs)
{
  std::vector<PositionPair> positions;
  for (const PosePair& pair : pairs)
    positions.push_back({Timestamp{}, pair.map_T_body.translation, pair.reference_T_body.translation});
  return positions;
}

/** The indices i of the RPE: each pair begins where the one before ended. */
std::vector<std::size_t> endsOfPairs(const std::vector<PositionPair>& pairs)
{
  constexpr double kPairLength = 1;  // m
  std::vector<std::size_t> ends;
  double passed = 0;
  for (std::size_t i = 1; i < pairs.size(); ++i)
  {
    passed += (pairs[i].map_p - pairs[i - 1].map_p).norm();
    if (passed < kPairLength) continue;
    ends.push_back(i);
    passed = 0;
  }
  return ends;
}
}  // namespace

std::vector<PosePair> posePairs(const Trajectory& estimate, const Eigen::Vector3d& body_p_point,
                                const Trajectory& reference)
{
  const Rigid body_T_point{Eigen::Quaterniond::Identity(), body_p_point};
  std::vector<PosePair> pairs;
  for (const StampedPose& pose : estimate)
    if (const auto truth = poseAt(reference, pose.stamp))
      pairs.push_back({pose.map_T_body * body_T_point, *truth * body_T_point});
  return pairs;
}

PoseErrors absoluteErrors(const std::vector<PosePair>& pairs, AlignmentKind kind)
{
  const Rigid reference_T_map = align(positionsOf(pairs), kind).reference_T_map;
  std::vector<Rigid> differences;
  for (const PosePair& pair : pairs)
    differences.push_back(pair.reference_T_body.inverse() * reference_T_map * pair.map_T_body);
  return errorsOf(differences);
}

PoseErrors absoluteErrors(const std::vector<PositionPair>& pairs, AlignmentKind kind)
{
  const Rigid reference_T_map = align(pairs, kind).reference_T_map;
  std::vector<double> metres;
  for (const PositionPair& pair : pairs) metres.push_back((reference_T_map * pair.map_p - pair.reference_p).norm());
  return {sizeOf(metres), std::nullopt, pairs.size()};
}

PoseErrors relativeErrors(const std::vector<PosePair>& pairs)
{
  const std::vector<std::size_t> ends = endsOfPairs(positionsOf(pairs));
  std::vector<Rigid> differences;
  for (std::size_t k = 1; k < ends.size(); ++k)
  {
    const PosePair &from = pairs[ends[k - 1]], &to = pairs[ends[k]];
    differences.push_back((from.reference_T_body.inverse() * to.reference_T_body).inverse() *
                          (from.map_T_body.inverse() * to.map_T_body));
  }
  return errorsOf(differences);
}

PoseErrors relativeErrors(const std::vector<PositionPair>& pairs)
{
  const std::vector<std::size_t> ends = endsOfPairs(pairs);
  std::vector<double> metres;
  for (std::size_t k = 1; k < ends.size(); ++k)
  {
    const PositionPair &from = pairs[ends[k - 1]], &to = pairs[ends[k]];
    metres.push_back((to.map_p - from.map_p).norm() - (to.reference_p - from.reference_p).norm());
  }
  return {sizeOf(metres), std::nullopt, metres.size()};
}
}  // namespace scanloom
