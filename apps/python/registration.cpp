#include "PythonScan.h"
#include "PythonWarnings.h"
#include "arrays.h"
#include "base/core/ConfigError.h"
#include "base/formats/CloudFile.h"
#include "bindings.h"
#include "lab/evaluation/RegistrationReport.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace py = pybind11;

namespace scanloom
{
namespace
{
struct FinitePoints
{
  CloudPair::Points points;
  std::size_t dropped = 0;
};

FinitePoints finite(CloudPair::Points points)
{
  const auto end = std::remove_if(points.begin(), points.end(), [](const auto& point) { return !point.allFinite(); });
  const auto dropped = static_cast<std::size_t>(points.end() - end);
  points.erase(end, points.end());
  return {std::move(points), dropped};
}

/** A file of points, a Scan or Cloud, or an array. */
FinitePoints pointsOf(const py::object& given, const char* name)
{
  if (py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__"))
  {
    CloudFile cloud = readCloud(given.cast<std::filesystem::path>());
    return {std::move(cloud.points), cloud.dropped};
  }
  return finite(pointsIn(py::isinstance<CloudMemory>(given) ? given.attr("xyz") : given, name));
}

PoseGuess guessOf(const py::object& guess, const std::optional<std::pair<double, double>>& sigma)
{
  const Rigid pose = guess.is_none() ? Rigid::identity() : poseIn(guess, "guess");
  if (!sigma) return pose;
  if (!(sigma->first > 0) || !(sigma->second > 0))
    throw UsageError(fmt::format("guess_sigma ({}, {}): must be (m, deg), both above 0", sigma->first, sigma->second));
  return guessWithin(pose, {sigma->first, sigma->second});
}

std::string doubtOf(const RegistrationReport& report)
{
  if (!report.registration.result.trustworthy())
    return fmt::format("the registration is not trustworthy: {}", toString(report.registration.result.outcome));
  return fmt::format(
      "the registration is not confirmed: another pose, {:.2f} m and {:.1f} deg away, may be the true one: give a "
      "better guess, and how good it is (guess_sigma)",
      report.contradiction->metres, report.contradiction->degrees);
}

RegistrationReport registerClouds(const py::object& target, const py::object& source, const py::object& guess,
                                  const std::optional<std::pair<double, double>>& sigma)
{
  const FinitePoints fixed = pointsOf(target, "target"), moving = pointsOf(source, "source");
  const PoseGuess known = guessOf(guess, sigma);
  RegistrationReport report;
  {
    const py::gil_scoped_release others_may_run;
    report = registrationReport(fixed.points, moving.points, known);
  }
  report.points.target_dropped = fixed.dropped;
  report.points.source_dropped = moving.dropped;
  if (!report.trustworthy()) warnInPython({doubtOf(report)}, WarnedLine::CallingScanloom);
  return report;
}

/** A row for each direction. */
Eigen::MatrixXd rowsOf(const std::vector<Vector6d>& directions)
{
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(directions.size()), 6);
  for (std::size_t i = 0; i < directions.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = directions[i].transpose();
  return rows;
}
}  // namespace

void bindRegistration(py::module_& m)
{
  using Report = RegistrationReport;
  py::class_<Report>(m, "Registration", "The pose of one cloud in another. str() is the program's report.")
      .def_property_readonly(
          "T", [](const Report& report) { return report.registration.result.target_T_source.matrix(); },
          "(4, 4) float64: target_T_source, maps points of the source to the target's frame.")
      .def_property_readonly(
          "covariance", [](const Report& report) { return report.registration.result.covariance; },
          "(6, 6) float64: (translation m, rotation rad) along the source's axes; 0 without overlap.")
      .def_property_readonly(
          "outcome", [](const Report& report) { return toString(report.registration.result.outcome); },
          "str: what `scanloom register` prints as outcome.")
      .def_property_readonly(
          "degenerate_directions",
          [](const Report& report) { return rowsOf(report.registration.result.degenerate_directions); },
          "(K, 6) float64: unit steps (m, m, m, rad times 5 m) that no structure resists.")
      .def_property_readonly(
          "overlap", [](const Report& report) { return report.registration.result.overlap; },
          "float, 0 to 1: share of the source's points that meet the target.")
      .def_property_readonly(
          "iterations", [](const Report& report) { return report.registration.result.iterations; }, "int")
      .def_property_readonly("trustworthy", &Report::trustworthy, "bool: the program would end with status 0, not 3.")
      .def("__str__", [](const Report& report) { return toText(report); });
  m.def("register", &registerClouds, py::arg("target"), py::arg("source"), py::arg("guess"), py::arg("guess_sigma"));
}
}  // namespace scanloom
