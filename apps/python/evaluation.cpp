#include "Pose.h"
#include "PythonWarnings.h"
#include "Reference.h"
#include "arrays.h"
#include "base/core/ConfigError.h"
#include "base/formats/TrajectoryReader.h"
#include "bindings.h"
#include "lab/evaluation/EvaluationReport.h"
#include "trajectoryOf.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <nlohmann/json.hpp>

#include <stdexcept>
#include <utility>
#include <variant>

namespace py = pybind11;

namespace scanloom
{
namespace
{
using Warnings = std::vector<std::string>;
using FileOrPoses = std::variant<std::filesystem::path, std::vector<Pose>>;

void addIfAny(Warnings& warnings, const std::string& text)
{
  if (!text.empty()) warnings.push_back(text);
}

Trajectory trajectoryOf(const FileOrPoses& given, Warnings& warnings)
{
  if (const auto* poses = std::get_if<std::vector<Pose>>(&given)) return trajectoryOf(*poses);
  return readTrajectory(std::get<std::filesystem::path>(given),
                        [&](const std::string& note) { warnings.push_back(note); });
}

std::variant<PositionTrack, Trajectory> referenceOf(const FileOrPoses& given, const std::string& topic,
                                                    Warnings& warnings)
{
  if (const auto* poses = std::get_if<std::vector<Pose>>(&given)) return trajectoryOf(*poses);
  return readReference(std::get<std::filesystem::path>(given), topic,
                       [&](const std::string& note) { warnings.push_back(note); });
}

AlignmentKind alignmentOf(const std::string& name)
{
  if (name == "yaw") return AlignmentKind::Yaw;
  if (name == "se3") return AlignmentKind::Se3;
  throw UsageError(fmt::format("align '{}': must be 'yaw' or 'se3'", name));
}

Evaluation evaluateFiles(const FileOrPoses& trajectory, const FileOrPoses& reference, const std::string& align,
                         const py::object& lever_arm, const std::string& reference_topic)
{
  EvaluationOptions options;
  options.body_p_point = vectorIn(lever_arm, "lever_arm");
  options.alignment = alignmentOf(align);
  Warnings warnings;
  Evaluation evaluation;
  {
    const py::gil_scoped_release others_may_run;
    EvaluationInput input;
    input.scans = trajectoryOf(trajectory, warnings);
    input.reference = referenceOf(reference, reference_topic, warnings);
    addIfAny(warnings, missingLeverArm(input, options));
    evaluation = evaluate(input, options);
    if (options.alignment == AlignmentKind::Yaw) addIfAny(warnings, tiltedReference(evaluation, input, options));
  }
  warnInPython(warnings, WarnedLine::CallingScanloom);
  return evaluation;
}
}  // namespace

void bindEvaluation(py::module_& m)
{
  py::class_<Evaluation>(m, "Evaluation", "A trajectory compared with a reference. str() is the program's report.")
      .def_property_readonly(
          "drift", [](const Evaluation& e) { return e.drift.largest; },
          "float, m: largest distance from the reference after alignment on the first 10 % of the path.")
      .def_property_readonly(
          "drift_percent", [](const Evaluation& e) { return e.drift.percent(); },
          "float: the drift in % of the path; None if the machine stood still.")
      .def_property_readonly(
          "path_length", [](const Evaluation& e) { return e.drift.path_length; }, "float, m: of the reference.")
      .def_property_readonly(
          "covered", [](const Evaluation& e) { return e.covered; },
          "float, 0 to 1: share of the reference's time with poses.")
      .def_property_readonly(
          "ape", [](const Evaluation& e) { return e.absolute.metres.rmse; },
          "float, m: root mean square of the absolute position errors, aligned on all poses.")
      .def_property_readonly(
          "rpe", [](const Evaluation& e) { return e.relative.metres.rmse; },
          "float, m: root mean square of the relative position errors over 1 m.")
      .def(
          "as_dict", [](const Evaluation& e) { return py::module_::import("json").attr("loads")(toJson(e).dump()); },
          "dict: all that `scanloom evaluate --json` prints.")
      .def("__str__", [](const Evaluation& e) { return toText(e); });
  m.def("evaluate", &evaluateFiles, py::arg("trajectory"), py::arg("reference"), py::arg("align"), py::arg("lever_arm"),
        py::arg("reference_topic"));
}
}  // namespace scanloom
