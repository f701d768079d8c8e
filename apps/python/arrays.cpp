#include "arrays.h"

#include "base/core/ConfigError.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace py = pybind11;

namespace scanloom
{
namespace
{
/** `axes` with -1 where any length will do. */
template <typename T>
py::array_t<T, py::array::c_style | py::array::forcecast> arrayIn(const py::handle& given, const char* name,
                                                                  const std::vector<py::ssize_t>& axes)
{
  const auto array = py::array_t<T, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!array) PyErr_Clear();
  bool fits = array && array.ndim() == static_cast<py::ssize_t>(axes.size());
  for (std::size_t i = 0; fits && i < axes.size(); ++i)
    fits = axes[i] < 0 || array.shape(static_cast<py::ssize_t>(i)) == axes[i];
  if (fits) return array;
  std::vector<std::string> lengths;
  for (const py::ssize_t length : axes) lengths.push_back(length < 0 ? "N" : fmt::format("{}", length));
  const auto kind = py::str(py::type::of(given).attr("__name__")).cast<std::string>();
  const std::string got = array ? fmt::format("has the shape {}", py::str(array.attr("shape")).cast<std::string>())
                                : fmt::format("is of type {}", kind);
  throw UsageError(fmt::format("{} {}: must be an array of shape ({}{})", name, got, fmt::join(lengths, ", "),
                               lengths.size() == 1 ? "," : ""));
}
}  // namespace

std::vector<Eigen::Vector3f> pointsIn(const py::handle& given, const char* name)
{
  const auto array = arrayIn<float>(given, name, {-1, 3});
  std::vector<Eigen::Vector3f> points(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = Eigen::Map<const Eigen::Vector3f>(array.data() + 3 * i);
  return points;
}

Eigen::Vector3d vectorIn(const py::handle& given, const char* name)
{
  const auto array = arrayIn<double>(given, name, {3});
  return Eigen::Map<const Eigen::Vector3d>(array.data());
}

Rigid poseIn(const py::handle& given, const char* name)
{
  const auto array = arrayIn<double>(given, name, {4, 4});
  try
  {
    return Rigid::fromMatrix(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(array.data()));
  }
  catch (const std::invalid_argument& problem)
  {
    throw UsageError(fmt::format("{}: {}", name, problem.what()));
  }
}

std::vector<std::int64_t> integersIn(const py::handle& given, const char* name)
{
  if (given.is_none()) return {};
  const auto array = arrayIn<std::int64_t>(given, name, {-1});
  return {array.data(), array.data() + array.size()};
}
}  // namespace scanloom
