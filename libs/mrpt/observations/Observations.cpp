#include "mrpt/observations/Observations.h"

#include "base/core/Text.h"
#include "input/rawlogs/Conversions.h"
#include "mrpt/observations/CGenericPointsMap.h"
#include "mrpt/observations/RecordingHeaderJson.h"
#include "mrpt/observations/readByAll.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace scanloom
{
namespace
{
const std::string kMarkBegin = "mark: ";

using mrpt::maps::CGenericPointsMap;
using mrpt::maps::CPointsMap;

void setPositions(const PointCloud& points, CPointsMap& map)
{
  map.resize(points.size());
  for (std::size_t i = 0; i < points.size(); i++) map.setPointFast(i, points.x[i], points.y[i], points.z[i]);
  map.mark_as_modified();
}

template <typename Values, typename Field>
void setField(const Values& values, Field* field)
{
  field->assign(values.begin(), values.end());
}

CPointsMap::Ptr genericCloud(const PointCloud& points, Duration start_after_stamp)
{
  auto map = CGenericPointsMap::Create();
  map->registerField_float("intensity");
  map->registerField_float("t");
  map->registerField_uint16("ring");
  map->registerField_uint16("column");
  map->registerField_uint8("sensor_id");
  setPositions(points, *map);
  setField(points.intensity, map->getPointsBufferRef_float_field("intensity"));
  setField(points.ring, map->getPointsBufferRef_uint16_field("ring"));
  setField(points.column, map->getPointsBufferRef_uint16_field("column"));
  setField(points.sensor_id, map->getPointsBufferRef_uint8_field("sensor_id"));
  auto& t = *map->getPointsBufferRef_float_field("t");
  for (std::size_t i = 0; i < points.size(); i++)
    t[i] = static_cast<float>(seconds(Duration{points.t[i]} + start_after_stamp));
  return map;
}

/** MRPT's class wants intensities in [0, 1]; reflectivity is calibrated to 0 to 255. */
constexpr float kFullIntensity = 255.f;

CPointsMap::Ptr xyziCloud([[maybe_unused]] const PointCloud& points)
{
#if SCANLOOM_HAS_XYZI
  auto map = std::make_shared<XyziReadByAll>();
  setPositions(points, *map);
  for (std::size_t i = 0; i < points.size(); i++)
    map->setPointIntensity(i, static_cast<float>(points.intensity[i]) / kFullIntensity);
  return map;
#else
  throw std::invalid_argument("cloud_class = CPointsMapXYZI: this MRPT has it no more, use CGenericPointsMap");
#endif
}

template <typename Values, typename Field>
void takeField(const Field* field, Values& values)
{
  if (field) values.assign(field->begin(), field->end());
}

/** NaN becomes 0. */
std::uint8_t reflectivity(float intensity)
{
  return static_cast<std::uint8_t>(std::lround(std::fmin(std::fmax(intensity, 0.f), 255.f)));
}

/** The nearest that fits; NaN becomes the least. */
std::int32_t toNanoseconds(float t)
{
  using Limits = std::numeric_limits<std::int32_t>;
  return static_cast<std::int32_t>(
      std::lround(std::fmin(std::fmax(1e9 * static_cast<double>(t), Limits::min()), Limits::max())));
}

void takeFields(const CGenericPointsMap& map, PointCloud& points)
{
  if (const auto* intensity = map.getPointsBufferRef_float_field("intensity"))
    std::transform(intensity->begin(), intensity->end(), points.intensity.begin(), reflectivity);
  takeField(map.getPointsBufferRef_uint16_field("ring"), points.ring);
  takeField(map.getPointsBufferRef_uint16_field("column"), points.column);
  takeField(map.getPointsBufferRef_uint8_field("sensor_id"), points.sensor_id);
  if (const auto* t = map.getPointsBufferRef_float_field("t"))
    std::transform(t->begin(), t->end(), points.t.begin(), toNanoseconds);
}

void takeIntensity([[maybe_unused]] const CPointsMap& map, [[maybe_unused]] PointCloud& points)
{
#if SCANLOOM_HAS_XYZI
  const auto* xyzi = dynamic_cast<const mrpt::maps::CPointsMapXYZI*>(&map);
  if (!xyzi) return;
  for (std::size_t i = 0; i < points.size(); i++)
    points.intensity[i] = reflectivity(xyzi->getPointIntensity_fast(i) * kFullIntensity);
#endif
}

void takePositions(const CPointsMap& map, const Rigid& body_T_sensor, PointCloud& points)
{
  const Eigen::Isometry3f body_T_cloud(body_T_sensor.matrix().cast<float>());
  const bool in_body_frame = body_T_cloud.matrix().isIdentity(0);
  points.resize(map.size());
  for (std::size_t i = 0; i < map.size(); i++)
  {
    Eigen::Vector3f p;
    map.getPointFast(i, p.x(), p.y(), p.z());
    if (!in_body_frame) p = body_T_cloud * p;
    points.x[i] = p.x();
    points.y[i] = p.y();
    points.z[i] = p.z();
  }
}

constexpr float kFarthestPoint = 1e5F;  // m, along an axis of the body: no lidar sees so far

/** Longer than any measurement block, shorter than any turn: distinguishes two blocks of the same id. */
constexpr std::int64_t kLongestBlock = 1'000'000;  // ns

std::vector<Column> columnsOf(const PointCloud& points, Timestamp start)
{
  std::vector<Column> columns;
  std::int64_t column_t = 0;
  for (std::size_t i = 0; i < points.size(); i++)
  {
    const bool same = !columns.empty() && columns.back().sensor_id == points.sensor_id[i] &&
                      columns.back().measurement_id == points.column[i] &&
                      std::abs(points.t[i] - column_t) < kLongestBlock && columns.back().count < 65535;
    if (!same)
    {
      column_t = points.t[i];
      Column column;
      column.stamp = start + Duration{column_t};
      column.first_point = static_cast<std::uint32_t>(i);
      column.measurement_id = points.column[i];
      column.sensor_id = points.sensor_id[i];
      columns.push_back(column);
    }
    columns.back().count++;
  }
  return columns;
}

Duration untilAfterTheLast(const Array<std::int32_t>& t)
{
  return t.empty() ? Duration{0} : Duration{*std::max_element(t.begin(), t.end())} + 1ns;
}

PointCloud pointsOf(const CPointsMap& map, const Rigid& frame_T_points)
{
  PointCloud points;
  takePositions(map, frame_T_points, points);
  if (const auto* generic = dynamic_cast<const CGenericPointsMap*>(&map))
    takeFields(*generic, points);
  else
    takeIntensity(map, points);
  return points;
}

PointCloud pointsOf(const mrpt::obs::CObservationPointCloud& observation)
{
  observation.load();
  if (!observation.pointcloud) return {};
  return pointsOf(*observation.pointcloud, fromMrpt(observation.sensorPose));
}

Scan scanOf(PointCloud points, Timestamp start, const std::optional<RecordingHeader>& header)
{
  Scan scan;
  scan.start = start;
  scan.points = std::move(points);
  scan.columns = columnsOf(scan.points, scan.start);
  const Duration period = header ? header->period() : Duration{0};
  scan.period = period > Duration{0} ? period : untilAfterTheLast(scan.points.t);
  if (header) scan.columns_of.resize(header->lidars.size());
  for (const Column& column : scan.columns)
  {
    if (column.sensor_id >= scan.columns_of.size()) scan.columns_of.resize(column.sensor_id + 1u);
    scan.columns_of[column.sensor_id]++;
  }
  return scan;
}
}  // namespace

CloudClass cloudClassFromName(const std::string& name, const std::string& key)
{
  if (name == "CGenericPointsMap") return CloudClass::CGenericPointsMap;
  if (name == "CPointsMapXYZI") return CloudClass::CPointsMapXYZI;
  throw std::invalid_argument(fmt::format("{} = {}: must be CGenericPointsMap or CPointsMapXYZI", key, name));
}

bool isSlice(const mrpt::obs::CObservation& observation)
{
  const std::string& label = observation.sensorLabel;
  const std::size_t length = std::strlen(kSliceSuffix);
  return label.size() > length && label.compare(label.size() - length, length, kSliceSuffix) == 0;
}

mrpt::obs::CObservationPointCloud::Ptr toObservation(const Scan& scan, CloudClass cloud, const std::string& label)
{
  auto observation = mrpt::obs::CObservationPointCloud::Create();
  observation->sensorLabel = label;
  observation->timestamp = toMrpt(scan.start);
  observation->pointcloud = cloud == CloudClass::CPointsMapXYZI
                                ? xyziCloud(scan.points)
                                : genericCloud(scan.points, scan.start - fromMrpt(observation->timestamp));
  return observation;
}

Scan fromObservation(const mrpt::obs::CObservationPointCloud& observation, const std::optional<RecordingHeader>& header)
{
  return scanOf(pointsOf(observation), fromMrpt(observation.timestamp), header);
}

Scan measuredScan(const mrpt::obs::CObservationPointCloud& observation, const std::optional<RecordingHeader>& header)
{
  PointCloud points = pointsOf(observation);
  removeImpossible(points);
  return scanOf(std::move(points), fromMrpt(observation.timestamp), header);
}

PointCloud pointsIn(const CPointsMap& map) { return pointsOf(map, Rigid::identity()); }

void removeImpossible(PointCloud& points)
{
  std::vector<std::uint8_t> keep(points.size());
  for (std::size_t i = 0; i < points.size(); i++)
    keep[i] = (points.position(i).array().abs() < kFarthestPoint).all();  // false for NaN
  if (std::find(keep.begin(), keep.end(), 0) != keep.end()) points.keep(keep);
}

mrpt::obs::CObservationComment::Ptr toObservation(const EventMark& mark)
{
  auto comment = std::make_shared<CommentReadByAll>();
  comment->timestamp = toMrpt(mark.stamp);
  comment->text = kMarkBegin + mark.text;
  return comment;
}

std::optional<EventMark> markIn(const mrpt::obs::CObservation& observation)
{
  const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(&observation);
  if (!comment || comment->text.rfind(kMarkBegin, 0) != 0) return std::nullopt;
  return EventMark{fromMrpt(comment->timestamp), printable(comment->text.substr(kMarkBegin.size()))};
}

mrpt::obs::CObservationComment::Ptr toObservation(const RecordingHeader& header, Timestamp stamp)
{
  auto comment = std::make_shared<CommentReadByAll>();
  comment->sensorLabel = kHeaderLabel;
  comment->timestamp = toMrpt(stamp);
  comment->text = toJson(header);
  return comment;
}
}  // namespace scanloom
