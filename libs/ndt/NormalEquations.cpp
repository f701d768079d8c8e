#include "ndt/NormalEquations.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <vector>

namespace scanloom
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

/** With steps in the target's frame: J = [I, -skew(v)], v the turned mean less the translation. */
struct ChunkSums
{
  double score = 0, met_points = 0;
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
  Matrix3d weight = Matrix3d::Zero(), weight_v = Matrix3d::Zero(), v_weight_v = Matrix3d::Zero();
};

ChunkSums sumOf(const Neighbourhoods& all, std::size_t index, const Vector3d& translation, double d2)
{
  const Neighbourhoods::Chunk& chunk = all.chunk(index);
  std::array<PairSums, Neighbourhoods::kChunk> sums;
  sumPairs(chunk.cells.data(), chunk.ranges.data(), chunk.cells.size(), chunk.blocks.data(), d2, sums.data());
  const double reach = std::exp(-1.0);
  ChunkSums total;
  for (std::size_t i = 0; i < chunk.cells.size(); ++i)
  {
    const PairSums& s = sums[i];
    if (chunk.ranges[i].count == 0) continue;
    total.score += s.score;
    if (s.best >= reach) total.met_points += all.source()[chunk.first + i].points;
    Matrix3d weight;
    weight << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
    const Vector3d v = Vector3d(chunk.cells[i].x, chunk.cells[i].y, chunk.cells[i].z) - translation;
    const Vector3d force(s.fx, s.fy, s.fz);
    const Matrix3d cross = skew(v), weight_v = weight * cross;
    total.force += force;
    total.torque += v.cross(force);
    total.weight += weight;
    total.weight_v += weight_v;
    total.v_weight_v += cross * weight_v;
  }
  return total;
}
}  // namespace

NormalEquations normalEquations(Neighbourhoods& all, const Rigid& target_T_source, double d2)
{
  std::vector<ChunkSums> chunks(all.chunks());
  tbb::parallel_for(std::size_t{0}, chunks.size(),
                    [&](std::size_t i)
                    {
                      all.moveTo(target_T_source, i);
                      chunks[i] = sumOf(all, i, target_T_source.translation, d2);
                    });
  ChunkSums sum;
  for (const ChunkSums& chunk : chunks)  // in a fixed order
  {
    sum.score += chunk.score, sum.met_points += chunk.met_points;
    sum.force += chunk.force, sum.torque += chunk.torque;
    sum.weight += chunk.weight, sum.weight_v += chunk.weight_v, sum.v_weight_v += chunk.v_weight_v;
  }

  // boxPlus steps in the source's frame.
  const Matrix3d rotation = target_T_source.rotation.toRotationMatrix();
  const auto turned = [&](const Matrix3d& m) { return Matrix3d(rotation.transpose() * m * rotation); };
  NormalEquations equations;
  equations.value = -sum.score;
  equations.met_points = sum.met_points;
  equations.gradient << rotation.transpose() * sum.force, rotation.transpose() * sum.torque;
  equations.curvature.topLeftCorner<3, 3>() = turned(sum.weight);
  equations.curvature.topRightCorner<3, 3>() = -turned(sum.weight_v);
  equations.curvature.bottomRightCorner<3, 3>() = -turned(sum.v_weight_v);
  equations.curvature.bottomLeftCorner<3, 3>() = equations.curvature.topRightCorner<3, 3>().transpose();
  return equations;
}
}  // namespace scanloom
