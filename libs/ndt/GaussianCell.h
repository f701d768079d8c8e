/** One cell's points as sums, and the normal distribution that the sums describe. */
#pragma once
#include <Eigen/Core>

#include <cstdint>

namespace scanloom
{
/** A normal distribution of the points in one cell, in the frame of its map. */
struct GaussianCell
{
  Eigen::Vector3d mean;        // m
  Eigen::Matrix3d covariance;  // m^2, no eigenvalue below the floor of the map's options
  std::uint32_t points = 0;

  /** Fewer points do not say how they are spread. */
  static constexpr int kTellsItsSpread = 4;

  /**
   * Takes away the directions in which the points fill the cell (variance near edge^2 / 12). There the mean tells where
   * the grid lies, not where the world does: a wall's cells resist sliding along it although nothing in the wall does.
   */
  Eigen::Matrix3d structure = Eigen::Matrix3d::Zero();
};

/**
 * Number, sum and sum of products of points, in units of kQuantum from the cell's own corner.
 *
 * Integers add without rounding: the sums are the same bits for any order of points, threads and merges, and what was
 * added can be taken out again without a trace. 15 um of resolution is far below any lidar's; 64 bits hold 20 million
 * points in a cell of 10 m, the largest that NdtOptions allows.
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
  /** The same points, counted from `corner` before the own one. */
  Moments about(const Eigen::Matrix<std::int64_t, 3, 1>& corner) const;

  Moments& operator+=(const Moments&);
  Moments& operator-=(const Moments&);
};

struct MeanAndCovariance
{
  Eigen::Vector3d mean;        // m
  Eigen::Matrix3d covariance;  // m^2
};

/** Of points whose sums are about `corner`; a single one has no covariance. */
MeanAndCovariance meanAndCovariance(const Moments&, const Eigen::Vector3d& corner);

/**
 * The Gaussian of the points in a cell of `edge` m whose sums are about its `corner`. Eigenvalues below
 * min_deviation^2 are raised to it: walls and stems are thinner than the noise of their cells is known. Of fewer than
 * kTellsItsSpread points the covariance is that of one more with a deviation of 8 cm to all sides: what a beam meets
 * far away is some stem or branch, and where in it is open.
 */
GaussianCell gaussianOf(const Moments&, const Eigen::Vector3d& corner, double edge, double min_deviation);
}  // namespace scanloom
