/** Point clouds whose memory Python sees. */
#pragma once
#include "base/core/PointCloud.h"

#include <pybind11/numpy.h>

namespace scanloom
{
/**
 * The points of a scan or of a pose. The libraries keep x, y and z in three arrays, which no view of numpy can show as
 * one of shape (N, 3): whoever asks for positions first moves them into one, from where on all views are of that.
 */
class CloudMemory
{
 public:
  explicit CloudMemory(PointCloud points) : points_(std::move(points)) {}

  std::size_t size() const { return points_.t.size(); }

  /** x y z of each point behind each other, m. */
  Array<float>& positions();

  /** All fields but x, y and z, which may have moved. */
  PointCloud& fields() { return points_; }

  /** With x, y and z. */
  PointCloud copy() const;

 private:
  PointCloud points_;
  Array<float> positions_;  // empty: x, y and z are in points_
};

/** A view of memory that `owner` keeps alive; it may be written. */
template <typename T>
pybind11::array viewOf(T* data, std::size_t size, std::size_t stride, const pybind11::object& owner)
{
  return pybind11::array_t<T>({static_cast<pybind11::ssize_t>(size)}, {static_cast<pybind11::ssize_t>(stride)}, data,
                              owner);
}

/** The same of `size` rows of three. */
template <typename T>
pybind11::array rowsOfThree(T* data, std::size_t size, std::size_t stride, const pybind11::object& owner)
{
  return pybind11::array_t<T>({static_cast<pybind11::ssize_t>(size), pybind11::ssize_t{3}},
                              {static_cast<pybind11::ssize_t>(stride), static_cast<pybind11::ssize_t>(sizeof(T))}, data,
                              owner);
}
}  // namespace scanloom
