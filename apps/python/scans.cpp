#include "InputWarnings.h"
#include "OpenedInput.h"
#include "PythonScan.h"
#include "PythonWarnings.h"
#include "bindings.h"
#include "input/rig/silentLidars.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>
#include <utility>

namespace py = pybind11;

namespace scanloom
{
namespace
{
/** The IMU samples of a scan; the scan keeps their memory. */
struct ImuView
{
  std::shared_ptr<PythonScan> scan;

  std::vector<SensorImu>& samples() const { return scan->imu(); }
};

template <typename T>
py::array columnOf(Array<T>& field, const py::object& owner)
{
  return viewOf(field.data(), field.size(), sizeof(T), owner);
}

py::array coordinate(const py::object& self, std::size_t axis)
{
  auto& cloud = self.cast<CloudMemory&>();
  return viewOf(cloud.positions().data() + axis, cloud.size(), 3 * sizeof(float), self);
}

template <typename Number>
py::array imuColumn(const py::object& self, Number* (*numberOf)(SensorImu&))
{
  std::vector<SensorImu>& samples = self.cast<ImuView&>().samples();
  return viewOf(samples.empty() ? nullptr : numberOf(samples.front()), samples.size(), sizeof(SensorImu), self);
}

py::array imuVectors(const py::object& self, double* (*vectorOf)(SensorImu&))
{
  std::vector<SensorImu>& samples = self.cast<ImuView&>().samples();
  return rowsOfThree(samples.empty() ? nullptr : vectorOf(samples.front()), samples.size(), sizeof(SensorImu), self);
}

/** The scans of an input, one by one. */
class ScanStream
{
 public:
  explicit ScanStream(const InputArguments& arguments) : opened_(openInput(arguments)), input_(*opened_.input.sensors)
  {
    say(std::exchange(opened_.warnings, {}));
  }

  /** Called with the GIL, which is released while the input is read. */
  std::shared_ptr<PythonScan> next()
  {
    constexpr Duration kPatience = 100ms;  // of a person who presses Ctrl-C
    while (!over_)
    {
      std::optional<SensorEvent> event;
      {
        const py::gil_scoped_release others_may_run;
        event = input_.next(kPatience);
        say(input_warnings_.due(input_));
        over_ = !event && input_.ended();
        if (over_) judge();
      }
      warnInPython(std::exchange(unsaid_, {}), WarnedLine::Calling);
      if (event)
        if (const auto* sample = std::get_if<SensorImu>(&*event)) imu_.push_back(*sample);
      if (event)
        if (auto* scan = std::get_if<Scan>(&*event))
          return std::make_shared<PythonScan>(std::move(*scan), std::exchange(imu_, {}));
      throwIfSignalled();
    }
    throw py::stop_iteration();
  }

  /** What the program prints before it begins. Called with the GIL. */
  void warnOfOpening() { warnInPython(std::exchange(unsaid_, {}), WarnedLine::CallingScanloom); }

  std::vector<std::string> lidars() const { return lidarNames(input_.setup().header); }
  const std::vector<std::string>& notes() const { return opened_.notes; }
  const std::vector<std::string>& warnings() const { return warnings_; }

  /** Known at the end. */
  std::optional<bool> good() const { return over_ ? std::optional(good_) : std::nullopt; }

  std::map<std::string, std::uint64_t> counts() const { return countsOf(input_.account()); }

 private:
  void say(const std::vector<std::string>& warnings)
  {
    for (const std::string& warning : warnings)
    {
      warnings_.push_back(warning);
      unsaid_.push_back(warning);
    }
  }

  /** As the program does by its exit status. */
  void judge()
  {
    say(input_.takeWarnings());
    const RigAccount account = input_.account();
    const std::vector<std::string> silent = silentLidars(account);
    say(silent);
    good_ = silent.empty() && wasReadWhole(account.input) && opened_.sensors_not_used == 0;
  }

  OpenedInput opened_;
  SensorInput& input_;
  InputWarnings input_warnings_;
  std::vector<SensorImu> imu_;  // after the last scan
  std::vector<std::string> warnings_, unsaid_;
  bool over_ = false, good_ = false;
};

void bindCloud(py::module_& m)
{
  py::class_<CloudMemory, std::shared_ptr<CloudMemory>>(
      m, "Cloud", "N points. Its arrays are views of one memory, which they keep alive, and may be written.")
      .def("__len__", &CloudMemory::size)
      .def_property_readonly(
          "xyz",
          [](const py::object& self)
          {
            auto& cloud = self.cast<CloudMemory&>();
            return rowsOfThree(cloud.positions().data(), cloud.size(), 3 * sizeof(float), self);
          },
          "(N, 3) float32, m: positions in the body frame at each point's own time.")
      .def_property_readonly(
          "x", [](const py::object& self) { return coordinate(self, 0); }, "xyz[:, 0]")
      .def_property_readonly(
          "y", [](const py::object& self) { return coordinate(self, 1); }, "xyz[:, 1]")
      .def_property_readonly(
          "z", [](const py::object& self) { return coordinate(self, 2); }, "xyz[:, 2]")
      .def_property_readonly(
          "t", [](const py::object& self) { return columnOf(self.cast<CloudMemory&>().fields().t, self); },
          "(N,) int32: ns after the stamp of the scan, or of the pose.")
      .def_property_readonly(
          "ring", [](const py::object& self) { return columnOf(self.cast<CloudMemory&>().fields().ring, self); },
          "(N,) uint8: channel of the lidar, 0 is the topmost beam.")
      .def_property_readonly(
          "lidar", [](const py::object& self) { return columnOf(self.cast<CloudMemory&>().fields().sensor_id, self); },
          "(N,) uint8: index of the lidar among `lidars` of the iterator.")
      .def_property_readonly(
          "intensity",
          [](const py::object& self) { return columnOf(self.cast<CloudMemory&>().fields().intensity, self); },
          "(N,) uint8: reflectivity as the sensor scales it.")
      .def_property_readonly(
          "range", [](const py::object& self) { return columnOf(self.cast<CloudMemory&>().fields().range, self); },
          "(N,) uint32: mm from the sensor.")
      .def_property_readonly(
          "column", [](const py::object& self) { return columnOf(self.cast<CloudMemory&>().fields().column, self); },
          "(N,) uint16: measurement id of the point's block.")
      .def_property_readonly(
          "signal", [](const py::object& self) { return columnOf(self.cast<CloudMemory&>().fields().signal, self); },
          "(N,) uint16: photons; 0 where the packets do not tell.")
      .def_property_readonly(
          "near_ir", [](const py::object& self) { return columnOf(self.cast<CloudMemory&>().fields().near_ir, self); },
          "(N,) uint16: photons; 0 where the packets do not tell.");
}

void bindScan(py::module_& m)
{
  py::class_<ImuView>(m, "ImuSamples", "M samples of IMUs. Its arrays are views of one memory.")
      .def("__len__", [](const ImuView& view) { return view.samples().size(); })
      .def_property_readonly(
          "stamp",
          [](const py::object& self)
          {
            return imuColumn<std::int64_t>(
                self, [](SensorImu& imu) { return reinterpret_cast<std::int64_t*>(&imu.sample.stamp); });
          },
          "(M,) int64: ns of the recording's clock.")
      .def_property_readonly(
          "gyro",
          [](const py::object& self)
          { return imuVectors(self, [](SensorImu& imu) { return imu.sample.gyro.data(); }); },
          "(M, 3) float64, rad/s, in the IMU's frame.")
      .def_property_readonly(
          "accel",
          [](const py::object& self)
          { return imuVectors(self, [](SensorImu& imu) { return imu.sample.accel.data(); }); },
          "(M, 3) float64, m/s2, in the IMU's frame: at rest 9.81 upwards.")
      .def_property_readonly(
          "sensor",
          [](const py::object& self) { return imuColumn<int>(self, [](SensorImu& imu) { return &imu.sensor; }); },
          "(M,) int32: -1 is the body's IMU, others are that of the lidar with this index.");

  py::class_<PythonScan, CloudMemory, std::shared_ptr<PythonScan>>(
      m, "Scan", "What all lidars measured in [stamp, stamp + period), in the order of time.")
      .def_property_readonly(
          "stamp", [](const PythonScan& scan) { return nanoseconds(scan.frame().start); },
          "int: start, ns of the recording's clock.")
      .def_property_readonly(
          "period", [](const PythonScan& scan) { return scan.frame().period.count(); }, "int, ns.")
      .def_property_readonly(
          "complete", [](const PythonScan& scan) { return scan.frame().complete(); },
          "bool: no lidar was late, silent or cut off.")
      .def_property_readonly(
          "missing",
          [](const PythonScan& scan)
          {
            std::vector<int> lidars;
            for (std::size_t i = 0; i < kMostLidars; ++i)
              if (scan.frame().missing[i]) lidars.push_back(static_cast<int>(i));
            return lidars;
          },
          "list of int: lidars of which measurements may be missing.")
      .def_property_readonly(
          "imu", [](std::shared_ptr<PythonScan> scan) { return ImuView{std::move(scan)}; },
          "ImuSamples: those that came after the scan before, and before this one.")
      .def("__repr__", [](const PythonScan& scan)
           { return fmt::format("<scanloom.Scan of {} points at {}>", scan.size(), nanoseconds(scan.frame().start)); });
}
}  // namespace

void bindScans(py::module_& m)
{
  bindCloud(m);
  bindScan(m);
  py::class_<InputArguments>(m, "InputArguments")
      .def(py::init<>())
      .def_readwrite("recording", &InputArguments::recording)
      .def_readwrite("configurations", &InputArguments::configurations)
      .def_readwrite("metadata", &InputArguments::metadata)
      .def_readwrite("assignments", &InputArguments::assignments)
      .def_readwrite("lidars", &InputArguments::lidars);
  py::class_<ScanStream>(m, "Scans", "Iterates over the scans of a recording or of live lidars.")
      .def(py::init(&opened<ScanStream>))
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__", &ScanStream::next)
      .def_property_readonly("lidars", &ScanStream::lidars, "list of str: their names, by the index in scan.lidar.")
      .def_property_readonly("notes", &ScanStream::notes, "list of str: what was recognised.")
      .def_property_readonly("warnings", &ScanStream::warnings, "list of str: so far.")
      .def_property_readonly("counts", &ScanStream::counts, "dict: what became of the packets so far.")
      .def_property_readonly("good", &ScanStream::good,
                             "bool: all was read and every lidar gave points; None before the end.");
}
}  // namespace scanloom
