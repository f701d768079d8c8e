#include "OpenedInput.h"
#include "PythonScan.h"
#include "PythonWarnings.h"
#include "Settings.h"
#include "arrays.h"
#include "base/core/ConfigError.h"
#include "bindings.h"
#include "estimation/slam/PlaceSearch.h"
#include "run/run/GivenMap.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>
#include <string>

namespace py = pybind11;

namespace scanloom
{
namespace
{
std::string doubtOf(PlaceOutcome outcome)
{
  if (outcome == PlaceOutcome::LookAlike) return "two places in this map look alike";
  if (outcome == PlaceOutcome::NotInMap) return "not in this map";
  return "the place is not confirmed: locate another scan some metres on, or tell where it is about";
}

/** A map that `scanloom slam` has made. */
class Site
{
 public:
  Site(const std::filesystem::path& folder, const ConfigurationArguments& configuration)
    : settings_(load<SlamVerbSettings>(configuration).settings), map_(readGivenMap(folder, "", settings_).map)
  {
  }

  SearchedPlace locate(PointCloud points, const Rigid& level_T_body, const std::optional<Rigid>& about) const
  {
    if (points.empty()) throw UsageError("the cloud has no points");
    for (const std::uint8_t lidar : points.sensor_id)
      if (lidar >= lidars().size())
        throw UsageError(fmt::format("a point of lidar {}: the drive of the map had {}", lidar, lidars().size()));
    std::optional<PlaceGuess> guess;
    if (about) guess = PlaceGuess{*about};
    PlaceSearch search(map_, settings_, lidars(), guess);
    return search.add({Timestamp{}, level_T_body, std::move(points)});
  }

  const std::vector<MountedLidar>& lidars() const { return map_->lidars(); }
  std::size_t keyframes() const { return map_->keyframes().size(); }

 private:
  SlamSettings settings_;
  std::shared_ptr<const PriorMap> map_;
};

PointCloud cloudIn(const py::object& given)
{
  if (py::isinstance<PythonScan>(given)) return given.cast<const PythonScan&>().copy().points;
  if (py::isinstance<CloudMemory>(given)) return given.cast<const CloudMemory&>().copy();
  throw UsageError("cloud: must be the cloud of a pose (slam(clouds=True)) or a scan of scans()");
}

SearchedPlace locate(const Site& site, const py::object& cloud, const py::object& level_T_body, const py::object& about)
{
  PointCloud points = cloudIn(cloud);
  const Rigid attitude = level_T_body.is_none() ? Rigid::identity() : poseIn(level_T_body, "level_T_body");
  std::optional<Rigid> known;
  if (!about.is_none()) known = poseIn(about, "about");
  SearchedPlace place;
  {
    const py::gil_scoped_release others_may_run;
    place = site.locate(std::move(points), attitude, known);
  }
  if (place.outcome != PlaceOutcome::Found) warnInPython({doubtOf(place.outcome)}, WarnedLine::CallingScanloom);
  return place;
}
}  // namespace

void bindSite(py::module_& m)
{
  py::class_<SearchedPlace>(m, "Place", "Where a cloud was found in a map.")
      .def_property_readonly(
          "outcome", [](const SearchedPlace& place) { return toString(place.outcome); },
          "str: found, unconfirmed, look alike or not in map.")
      .def_property_readonly(
          "map_T_body",
          [](const SearchedPlace& place) -> std::optional<Eigen::Matrix4d>
          {
            if (!place.place) return std::nullopt;
            return place.place->map_T_body.matrix();
          },
          "(4, 4) float64, or None where there is no place.")
      .def_property_readonly(
          "covariance",
          [](const SearchedPlace& place) -> std::optional<Matrix6d>
          {
            if (!place.place) return std::nullopt;
            return place.place->covariance;
          },
          "(6, 6) float64: (translation m, rotation rad) along the body's axes, or None.")
      .def_property_readonly(
          "agreement", [](const SearchedPlace& place) { return place.agreement; },
          "float: score of the best place over that of the cloud with itself; 1 if the map were made of it.");
  py::class_<Site>(m, "Site")
      .def(py::init(
               [](const std::filesystem::path& folder, const InputArguments& settings) {
                 return std::make_unique<Site>(folder,
                                               ConfigurationArguments{settings.configurations, settings.assignments});
               }),
           py::arg("folder"), py::arg("settings"))
      .def("locate", &locate, py::arg("cloud"), py::arg("level_T_body"), py::arg("about"))
      .def_property_readonly(
          "lidars",
          [](const Site& site)
          {
            std::vector<std::string> names;
            for (const MountedLidar& lidar : site.lidars()) names.push_back(lidar.name);
            return names;
          },
          "list of str: those of the map's drive, by index in cloud.lidar.")
      .def("__len__", &Site::keyframes);
}
}  // namespace scanloom
