#include "OpenedInput.h"
#include "PythonWarnings.h"
#include "RunReport.h"
#include "SlamThread.h"
#include "arrays.h"
#include "base/core/ConfigError.h"
#include "base/formats/TrajectoryWriter.h"
#include "bindings.h"
#include "run/run/GivenMap.h"
#include "trajectoryOf.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace py = pybind11;

namespace scanloom
{
namespace
{
/** What the program takes as --map and --at. */
struct MapArguments
{
  std::optional<std::filesystem::path> folder;
  std::string at;                   // empty: anywhere in the map
  std::optional<Rigid> map_T_body;  // in place of `at`
};

GivenMap givenMap(const MapArguments& arguments, const SlamSettings& settings)
{
  if (!arguments.folder) return {};
  GivenMap map = readGivenMap(*arguments.folder, arguments.at, settings);
  if (arguments.map_T_body) map.map_T_body = arguments.map_T_body;
  return map;
}

/** The poses of `scanloom slam`, one by one. */
class PoseStream
{
 public:
  PoseStream(const InputArguments& arguments, const MapArguments& map, KeptClouds kept)
    : PoseStream(openInput(arguments), map, kept)
  {
  }
  PoseStream(const PoseStream&) = delete;
  PoseStream& operator=(const PoseStream&) = delete;
  ~PoseStream()
  {
    const py::gil_scoped_release others_may_run;
    run_.reset();
  }

  /** Called with the GIL, which is released while it waits. */
  Pose next()
  {
    constexpr Duration kPatience = 100ms;  // of a person who presses Ctrl-C
    while (true)
    {
      std::optional<Pose> pose;
      {
        const py::gil_scoped_release others_may_run;
        pose = run_->next(kPatience);
      }
      report_.warn(run_->takeWarnings());
      if (pose) return *std::move(pose);
      if (run_->ended()) break;
      throwIfSignalled();
    }
    report_.end(run_->result());
    throw py::stop_iteration();
  }

  /** What the program prints before it begins. Called with the GIL. */
  void warnOfOpening() { report_.warn(warnings_of_opening_, WarnedLine::CallingScanloom); }

  std::vector<std::string> lidars() const { return lidarNames(input_->setup().header); }
  const std::vector<std::string>& notes() const { return notes_; }
  const RunReport& report() const { return report_; }

 private:
  PoseStream(OpenedInput opened, const MapArguments& map, KeptClouds kept)
    : input_(std::move(opened.input.sensors)),
      notes_(std::move(opened.notes)),
      warnings_of_opening_(std::move(opened.warnings)),
      report_(opened.sensors_not_used)
  {
    refuseUnknownImu(*input_, opened.settings.slam);
    constexpr std::size_t kAhead = 2;  // poses
    run_ = std::make_unique<SlamThread>(*input_, opened.settings, kept, kAhead, givenMap(map, opened.settings));
  }

  std::unique_ptr<SensorInput> input_;
  std::vector<std::string> notes_, warnings_of_opening_;
  RunReport report_;
  std::unique_ptr<SlamThread> run_;  // last: it uses the input
};

/** `at` is the program's text, a .tum file or (4, 4). */
MapArguments mapArguments(const std::optional<std::filesystem::path>& folder, const py::object& at)
{
  if (!folder && !at.is_none()) throw UsageError("at is a pose in the map of an earlier run: name its folder with map");
  MapArguments arguments{folder, "", {}};
  if (py::isinstance<py::str>(at) || py::hasattr(at, "__fspath__"))
    arguments.at = at.cast<std::filesystem::path>().string();
  else if (!at.is_none())
    arguments.map_T_body = poseIn(at, "at");
  return arguments;
}

void bindPose(py::module_& m)
{
  py::class_<Pose>(m, "Pose", "The machine at the end of a scan. Pose tangents are (translation m, rotation rad).")
      .def_property_readonly(
          "stamp", [](const Pose& pose) { return nanoseconds(pose.stamp); },
          "int: end of the scan, ns of the recording's clock.")
      .def_property_readonly(
          "map_T_body", [](const Pose& pose) { return pose.map_T_body.matrix(); },
          "(4, 4) float64: maps points of the body's frame to the map's; x forward, y left, z up.")
      .def_property_readonly(
          "position", [](const Pose& pose) { return pose.map_T_body.translation; }, "(3,) float64, m.")
      .def_property_readonly(
          "quaternion", [](const Pose& pose) { return Eigen::Vector4d(pose.map_T_body.rotation.coeffs()); },
          "(4,) float64: x y z w.")
      .def_readonly("covariance", &Pose::covariance,
                    "(6, 6) float64: of the pose in the local map, along the body's axes.")
      .def_readonly("covariance_since_start", &Pose::since_start,
                    "(6, 6) float64: of the pose relative to the first one.")
      .def_readonly("velocity", &Pose::velocity, "(3,) float64, m/s: of the IMU, in the map frame.")
      .def_property_readonly(
          "health", [](const Pose& pose) { return toString(pose.health); },
          "str: INITIALISING, OK, DEGENERATE or LOST.")
      .def_readonly("trusted", &Pose::trusted, "bool: the scan's registration was used.")
      .def_readonly("recovered", &Pose::recovered, "bool: found again, the pose does not continue the one before.")
      .def_readonly("map_restarted", &Pose::map_restarted, "bool: a new map begins here.")
      .def_readonly("in_map", &Pose::in_map, "bool: the map frame is that of the map given, slam(map=...).")
      .def_readonly("scan_complete", &Pose::scan_complete, "bool: no lidar was late, silent or cut off.")
      .def_readonly("imu_complete", &Pose::imu_complete, "bool: the IMU covered the scan in time.")
      .def_readonly("cloud", &Pose::cloud,
                    "Cloud, if slam(clouds=True), else None: in the body frame at `stamp`, cropped and deskewed.")
      .def("__repr__",
           [](const Pose& pose)
           {
             const Eigen::Vector3d& p = pose.map_T_body.translation;
             return fmt::format("<scanloom.Pose at {}: {:.3f} {:.3f} {:.3f} m, {}>", nanoseconds(pose.stamp), p.x(),
                                p.y(), p.z(), toString(pose.health));
           });
}
}  // namespace

void bindPoses(py::module_& m)
{
  bindPose(m);
  py::class_<PoseStream> run(m, "Slam", "Iterates over the poses of a run, which a thread of C++ computes meanwhile.");
  run.def(py::init(
              [](const InputArguments& arguments, const std::optional<std::filesystem::path>& map, const py::object& at,
                 bool clouds) {
                return opened<PoseStream>(arguments, mapArguments(map, at),
                                          clouds ? KeptClouds::All : KeptClouds::None);
              }),
          py::arg("input"), py::arg("map"), py::arg("at"), py::arg("clouds"))
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__", &PoseStream::next)
      .def_property_readonly("lidars", &PoseStream::lidars, "list of str: their names, by the index in cloud.lidar.")
      .def_property_readonly("notes", &PoseStream::notes, "list of str: what was recognised.");
  bindReport(run);
  m.def(
      "write_trajectory",
      [](const std::filesystem::path& file, const std::vector<Pose>& poses)
      { writeTrajectory(file, trajectoryOf(poses)); },
      py::arg("file"), py::arg("poses"));
}
}  // namespace scanloom
