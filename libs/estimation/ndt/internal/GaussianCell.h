/** The points of a cell as sums, and as a normal distribution. */
#pragma once
#include "estimation/ndt/internal/SymmetricBlock.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace scanloom
{
/** The normal distribution of the points in a cell, in the frame of the map. */
struct GaussianCell
{
  Eigen::Vector3d mean;        // m
  Eigen::Matrix3d covariance;  // m^2, eigenvalues at least NdtOptions::min_deviation squared
  std::uint32_t points = 0;

  /** With fewer points the covariance is assumed (see gaussiansOf). */
  static constexpr int kMinPointsForCovariance = 4;

  /**
   * Projector onto the thin directions of the points: near 0 where they fill the cell (variance near edge^2 / 12). In
   * such a direction the mean depends on the grid, not on the world: cells of a wall resist a motion along the wall
   * although nothing in the wall does.
   */
  Eigen::Matrix3d structure = Eigen::Matrix3d::Zero();
};

/**
 * Number, sum and sum of products of points, in units of kQuantum from the corner of the cell.
 *
 * Integers add without rounding: the sums have the same bits for any order of points, threads and merges, and points
 * can be removed again exactly. The resolution of 15 um is far finer than a lidar's; 64 bits hold 20 million points in
 * a cell of 10 m, the largest that NdtOptions allows.
 */
struct Moments
{
  static constexpr double kQuantum = 1.0 / 65536;  // m

  std::int64_t n = 0;
  std::int64_t x = 0, y = 0, z = 0;
  std::int64_t xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  void add(std::int64_t px, std::int64_t py, std::int64_t pz)
  {
    ++n;
    x += px, y += py, z += pz;
    xx += px * px, xy += px * py, xz += px * pz;
    yy += py * py, yz += py * pz, zz += pz * pz;
  }
  /** The same sums for points that are shifted by `corner`. */
  Moments about(const Eigen::Matrix<std::int64_t, 3, 1>& corner) const;

  Moments& operator+=(const Moments&);
  Moments& operator-=(const Moments&);
};

struct MeanAndCovariance
{
  Eigen::Vector3d mean;        // m
  Eigen::Matrix3d covariance;  // m^2
};

/** m, of points whose sums are about `corner`. */
Eigen::Vector3d meanOf(const Moments&, const Eigen::Vector3d& corner);

/** Mean and covariance of points whose sums are about `corner`. The covariance of a single point is zero. */
MeanAndCovariance meanAndCovariance(const Moments&, const Eigen::Vector3d& corner);

/** The points of a cell by their sums about its corner. */
struct CellPoints
{
  Moments moments;
  Eigen::Vector3d corner;  // m
};

/**
 * The Gaussians of up to kGaussiansAtOnce cells of `edge` m; the rest of the result is not set. Eigenvalues below
 * min_deviation^2 are raised to it, because the noise of thin walls and stems is not known better. For fewer than
 * kMinPointsForCovariance points the covariance is computed with one point more, of 8 cm standard deviation along each
 * axis: far away a beam hits a stem or branch, but where on it is not known.
 */
constexpr std::size_t kGaussiansAtOnce = SymmetricBlock::kLanes;
std::array<GaussianCell, kGaussiansAtOnce> gaussiansOf(const CellPoints* cells, std::size_t count, double edge,
                                                       double min_deviation);
}  // namespace scanloom
