#include "site/internal/siteGraph.h"

#include "estimation/graph/PoseGraph.h"
#include "estimation/ndt/FittedConstants.h"
#include "site/internal/Odometry.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace scanloom
{
namespace
{
/** A pose graph of some of the keyframes, which it numbers anew. */
class PieceGraph
{
 public:
  PieceGraph(const SiteMeasurements& measured, const std::vector<std::size_t>& piece,
             const std::vector<SiteDrive>& drives, const SiteLayout& layout)
    : piece_(piece)
  {
    addPoses(measured.keyframes);
    for (std::size_t d = 0; d < drives.size(); ++d) addDrive(drives[d].keyframes(), layout.firstOf(d));
    addLoops(measured.loops);
    addReferences(measured.references);
    if (references_.empty()) graph_.fixed = 0;
  }

  SiteMeasurements solved(SiteMeasurements measurements) const
  {
    const SolvedPoseGraph result = scanloom::solved(graph_);
    for (std::size_t n = 0; n < piece_.size(); ++n)
      measurements.keyframes[piece_[n]].site_T_body = result.map_T_body[n];
    for (std::size_t n = 0; n < loops_.size(); ++n)
    {
      Loop& loop = measurements.loops[loops_[n]];
      loop.distance = result.loop_distances[n];
      if (!result.loops_used[n]) loop.decision = LoopDecision::Contradicts;
    }
    for (std::size_t n = 0; n < references_.size(); ++n)
      measurements.references[references_[n]].used = result.positions_used[n];
    return measurements;
  }

  std::vector<SiteKeyframe> withCovariances(std::vector<SiteKeyframe> keyframes) const
  {
    const std::vector<Matrix6d> covariances = covariancesOf(graph_);
    for (std::size_t n = 0; n < piece_.size(); ++n) keyframes[piece_[n]].covariance = covariances[n];
    return keyframes;
  }

 private:
  void addPoses(const std::vector<SiteKeyframe>& keyframes)
  {
    for (const std::size_t i : piece_) graph_.map_T_body.push_back(keyframes[i].site_T_body);
  }

  void addDrive(const std::vector<DriveKeyframe>& keyframes, std::size_t first)
  {
    graph_.scale_sigma = fitted::kScaleError;
    for (OdometryPose edge : odometryOf(keyframes, first)) addEdge(std::move(edge), graph_.odometry);
    for (MeasuredUp up : upsOf(keyframes, first))
      if (const auto pose = numberOf(up.pose))
      {
        up.pose = *pose;
        graph_.ups.push_back(up);
      }
  }

  void addLoops(const std::vector<Loop>& loops)
  {
    for (std::size_t i = 0; i < loops.size(); ++i)
      if (loops[i].decision == LoopDecision::Accepted &&
          addEdge(RelativePose{loops[i].from, loops[i].to, loops[i].from_T_to, loops[i].covariance}, graph_.loops))
        loops_.push_back(i);
  }

  void addReferences(const std::vector<ReferencePosition>& references)
  {
    for (std::size_t i = 0; i < references.size(); ++i)
      if (const auto pose = numberOf(references[i].keyframe); pose && references[i].used)
      {
        graph_.positions.push_back({*pose, references[i].keyframe_p_point, references[i].measured,
                                    references[i].sigma * references[i].sigma * Eigen::Matrix3d::Identity(),
                                    references[i].share});
        references_.push_back(i);
      }
  }

  std::optional<std::size_t> numberOf(std::size_t keyframe) const
  {
    const auto at = std::lower_bound(piece_.begin(), piece_.end(), keyframe);
    if (at == piece_.end() || *at != keyframe) return std::nullopt;
    return static_cast<std::size_t>(at - piece_.begin());
  }

  template <typename Edge>
  bool addEdge(Edge edge, std::vector<Edge>& edges) const
  {
    const auto from = numberOf(edge.from), to = numberOf(edge.to);
    if (!from || !to) return false;
    edge.from = *from, edge.to = *to;
    edges.push_back(edge);
    return true;
  }

  const std::vector<std::size_t>& piece_;
  PoseGraph graph_;
  std::vector<std::size_t> loops_, references_;  // which of all are in the graph
};

bool isIn(const std::vector<std::size_t>& piece, const ReferencePosition& reference)
{
  return std::binary_search(piece.begin(), piece.end(), reference.keyframe);
}
}  // namespace

SiteMeasurements solvedPiece(SiteMeasurements measurements, const std::vector<std::size_t>& piece,
                             const std::vector<SiteDrive>& drives, const SiteLayout& layout)
{
  try
  {
    measurements = PieceGraph(measurements, piece, drives, layout).solved(measurements);
  }
  catch (const UnheldPoseGraph&)  // all its positions are refused
  {
    for (ReferencePosition& reference : measurements.references)
      if (isIn(piece, reference)) reference.used = false;
    measurements = PieceGraph(measurements, piece, drives, layout).solved(measurements);
  }
  for (ReferencePosition& reference : measurements.references)
    if (isIn(piece, reference))
      reference.residual =
          measurements.keyframes[reference.keyframe].site_T_body * reference.keyframe_p_point - reference.measured;
  return measurements;
}

std::vector<SiteKeyframe> withCovariances(const SiteMeasurements& measured, const std::vector<std::size_t>& piece,
                                          const std::vector<SiteDrive>& drives, const SiteLayout& layout)
{
  return PieceGraph(measured, piece, drives, layout).withCovariances(measured.keyframes);
}
}  // namespace scanloom
