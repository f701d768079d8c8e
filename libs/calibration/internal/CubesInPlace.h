/** What stays in place in the frame of a sensor that moves: parts of the machine that carries it, mostly. */
#pragma once
#include <Eigen/Core>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace scanloom
{
/** Counts the clouds that have points in each cube. */
class CubesInPlace
{
 public:
  explicit CubesInPlace(double edge) : edge_(edge) {}  // m

  void add(const std::vector<Eigen::Vector3f>& cloud);

  /** The clouds with a point in the cube of `p`. */
  int cloudsAt(const Eigen::Vector3f& p) const;

  int clouds() const { return clouds_; }

 private:
  struct Cube
  {
    int clouds = 0, last = -1;
  };
  double edge_;
  int clouds_ = 0;
  std::unordered_map<std::uint64_t, Cube> cubes_;  // never iterated: its order is not defined
};
}  // namespace scanloom
