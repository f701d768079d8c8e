#include "FedInput.h"
#include "OpenedInput.h"
#include "PythonScan.h"
#include "PythonWarnings.h"
#include "RunReport.h"
#include "Settings.h"
#include "SlamInput.h"
#include "SlamThread.h"
#include "arrays.h"
#include "base/core/ConfigError.h"
#include "bindings.h"
#include "cloudScan.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <limits>
#include <memory>
#include <utility>

namespace py = pybind11;

namespace scanloom
{
namespace
{
/** Name and body_T_sensor of each lidar; the pose of the body's IMU, or none. */
struct FedRig
{
  std::vector<RecordedLidar> lidars;
  std::optional<Rigid> body_T_imu;
};

SensorSetup setupOf(const FedRig& rig)
{
  SensorSetup setup;
  setup.header.lidars = rig.lidars;
  if (rig.body_T_imu) setup.body_T_imu[SensorImu::kBody] = *rig.body_T_imu;
  return setup;
}

/** `scanloom slam` on scans and samples that are given one by one. */
class Odometry
{
 public:
  Odometry(const FedRig& rig, const ConfigurationArguments& configuration)
    : lidars_(mountedLidars(rig.lidars)), input_(setupOf(rig)), report_(0)
  {
    const SlamVerbSettings settings = load<SlamVerbSettings>(configuration).settings;
    refuseUnknownImu(input_, settings.slam);
    constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();  // whoever feeds takes them
    run_ = std::make_unique<SlamThread>(input_, settings, KeptClouds::None, kAll);
  }
  Odometry(const Odometry&) = delete;
  Odometry& operator=(const Odometry&) = delete;
  ~Odometry()
  {
    const py::gil_scoped_release others_may_run;
    input_.stop();
    run_.reset();
  }

  std::vector<Pose> add(SensorEvent event)
  {
    if (finished_) throw UsageError("finish() was called: begin another Odometry");
    std::vector<Pose> poses;
    {
      const py::gil_scoped_release others_may_run;
      input_.add(std::move(event));
      constexpr Duration kPatience = 50ms;
      while (!input_.waitForReader(kPatience) && !run_->ended()) append(poses);
      append(poses);
    }
    report_.warn(run_->takeWarnings());
    return poses;
  }

  std::vector<Pose> addScan(Scan scan)
  {
    if (scan.end() <= last_end_)
      throw UsageError(fmt::format("a scan that ends at {} ns: must end after the one before, which ended at {}",
                                   nanoseconds(scan.end()), nanoseconds(last_end_)));
    last_end_ = scan.end();
    return add(std::move(scan));
  }

  std::vector<Pose> finish()
  {
    finished_ = true;
    std::vector<Pose> poses;
    {
      const py::gil_scoped_release others_may_run;
      input_.stop();
      constexpr Duration kPatience = 50ms;
      while (!run_->ended())
        if (std::optional<Pose> pose = run_->next(kPatience)) poses.push_back(*std::move(pose));
    }
    report_.warn(run_->takeWarnings());
    report_.end(run_->result());
    return poses;
  }

  const std::vector<MountedLidar>& lidars() const { return lidars_; }
  const RunReport& report() const { return report_; }

 private:
  void append(std::vector<Pose>& poses)
  {
    while (std::optional<Pose> pose = run_->next(Duration{0})) poses.push_back(*std::move(pose));
  }

  std::vector<MountedLidar> lidars_;
  FedInput input_;
  RunReport report_;
  Timestamp last_end_ = Timestamp::min();
  bool finished_ = false;
  std::unique_ptr<SlamThread> run_;  // last: it uses the input
};

FedRig rigOf(const py::dict& body_T_lidar, const py::object& body_T_imu)
{
  FedRig rig;
  for (const auto& [name, pose] : body_T_lidar)
  {
    RecordedLidar lidar;
    lidar.name = py::str(name);
    lidar.body_T_sensor = poseIn(pose, lidar.name.c_str());
    rig.lidars.push_back(lidar);
  }
  if (rig.lidars.empty() || rig.lidars.size() > kMostLidars)
    throw UsageError(fmt::format("{} lidars: must be from 1 to {}", rig.lidars.size(), kMostLidars));
  if (!body_T_imu.is_none()) rig.body_T_imu = poseIn(body_T_imu, "body_T_imu");
  return rig;
}

CloudArrays arraysOf(const py::object& xyz, const py::object& t, const py::object& lidar, const py::object& ring,
                     const py::object& intensity)
{
  return {pointsIn(xyz, "xyz"), integersIn(t, "t"), integersIn(lidar, "lidar"), integersIn(ring, "ring"),
          integersIn(intensity, "intensity")};
}
}  // namespace

void bindOdometry(py::module_& m)
{
  py::class_<Odometry> odometry(m, "Odometry", "Localisation with clouds and IMU samples that are given one by one.");
  odometry
      .def(py::init(
               [](const py::dict& body_T_lidar, const py::object& body_T_imu, const InputArguments& settings)
               {
                 return std::make_unique<Odometry>(
                     rigOf(body_T_lidar, body_T_imu),
                     ConfigurationArguments{settings.configurations, settings.assignments});
               }),
           py::arg("body_T_lidar"), py::arg("body_T_imu"), py::arg("settings"))
      .def(
          "add_imu",
          [](Odometry& self, std::int64_t stamp, const py::object& gyro, const py::object& accel)
          {
            return self.add(SensorImu{
                SensorImu::kBody, {fromNanoseconds(stamp), vectorIn(gyro, "gyro"), vectorIn(accel, "accel"), false}});
          },
          py::arg("stamp"), py::arg("gyro"), py::arg("accel"))
      .def(
          "add_scan", [](Odometry& self, const PythonScan& scan) { return self.addScan(scan.copy()); }, py::arg("scan"))
      .def(
          "add_cloud",
          [](Odometry& self, std::int64_t stamp, const py::object& xyz, const py::object& t, const py::object& lidar,
             const py::object& ring, const py::object& intensity, std::optional<std::int64_t> period)
          {
            std::optional<Duration> given;
            if (period) given = Duration{*period};
            return self.addScan(
                cloudScan(fromNanoseconds(stamp), given, arraysOf(xyz, t, lidar, ring, intensity), self.lidars()));
          },
          py::arg("stamp"), py::arg("xyz"), py::arg("t"), py::arg("lidar"), py::arg("ring"), py::arg("intensity"),
          py::arg("period"))
      .def("finish", &Odometry::finish);
  bindReport(odometry);
}
}  // namespace scanloom
