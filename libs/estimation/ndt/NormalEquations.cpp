#include "estimation/ndt/NormalEquations.h"

#include "base/core/Decompositions.h"
#include "estimation/ndt/internal/Symmetric3.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <vector>

namespace scanloom
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

struct ChunkSums
{
  double score = 0, met_points = 0;
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
  PoseSum curvature;
};

ChunkSums sumOf(const CellCorrespondences& all, std::size_t index, const Vector3d& translation, double d2)
{
  const CellCorrespondences::Chunk& chunk = all.chunk(index);
  std::array<ScoreSums, CellCorrespondences::kChunk> sums;
  sumPairs(chunk.pairs(), d2, sums.data());
  const double reach = std::exp(-1.0);
  ChunkSums total;
  for (std::size_t i = 0; i < chunk.cells.size(); ++i)
  {
    const ScoreSums& s = sums[i];
    if (chunk.ranges[i].count == 0) continue;
    total.score += s.score;
    if (s.best >= reach) total.met_points += all.source()[chunk.first + i].points;
    const Vector3d v = Vector3d(chunk.cells[i].x, chunk.cells[i].y, chunk.cells[i].z) - translation;
    const Vector3d force(s.fx, s.fy, s.fz);
    total.force += force;
    total.torque += v.cross(force);
    total.curvature.add({s.xx, s.xy, s.xz, s.yy, s.yz, s.zz}, v.x(), v.y(), v.z());
  }
  return total;
}
}  // namespace

Matrix6d targetOfStep(const Rigid& target_T_source)
{
  Matrix6d target_of_step = Matrix6d::Zero();
  target_of_step.topLeftCorner<3, 3>() = target_of_step.bottomRightCorner<3, 3>() =
      target_T_source.rotation.toRotationMatrix();
  return target_of_step;
}

NormalEquations normalEquations(CellCorrespondences& all, const Rigid& target_T_source, double d2)
{
  std::vector<ChunkSums> chunks(all.chunks());
  tbb::parallel_for(std::size_t{0}, chunks.size(),
                    [&](std::size_t i)
                    {
                      all.moveTo(target_T_source, i);
                      chunks[i] = sumOf(all, i, target_T_source.translation, d2);
                    });
  NormalEquations equations;
  Vector6d gradient = Vector6d::Zero();
  Matrix6d curvature = Matrix6d::Zero();
  for (const ChunkSums& chunk : chunks)  // in a fixed order
  {
    equations.value -= chunk.score;
    equations.met_points += chunk.met_points;
    gradient.head<3>() += chunk.force;
    gradient.tail<3>() += chunk.torque;
    curvature += chunk.curvature.matrix();
  }

  // boxPlus steps in the source's frame.
  const Matrix6d target_of_step = targetOfStep(target_T_source);
  equations.gradient = target_of_step.transpose() * gradient;
  equations.curvature = congruent(curvature, target_of_step);
  return equations;
}
}  // namespace scanloom
