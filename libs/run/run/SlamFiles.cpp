#include "run/run/SlamFiles.h"

#include "base/core/ConfigError.h"
#include "base/core/Text.h"
#include "mrpt/maps/SimpleMapReader.h"

#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

namespace scanloom
{
namespace
{
const std::filesystem::path& created(const std::filesystem::path& folder)
{
  std::filesystem::create_directories(folder);
  return folder;
}

double distance(const StampedPose& a, const StampedPose& b)
{
  return (a.map_T_body.translation - b.map_T_body.translation).norm();
}

/** Without what would end the column or the line, or what a spreadsheet would compute. */
std::string csvText(std::string text)
{
  text = notAFormula(text);
  for (char& c : text)
    if (c == ',' || c == '"' || c == '\n' || c == '\r') c = ' ';
  return text;
}

std::optional<RecordedImu> imuOf(const StateEstimate& e)
{
  return e.imu ? std::optional(RecordedImu{*e.imu, e.body_T_imu, kImuLabel}) : std::nullopt;
}

/** A map's lidars must be the drive's: a point's ray begins at its lidar. */
std::uint8_t sameLidar(const MountedLidar& lidar, const std::vector<RecordedLidar>& lidars,
                       const std::filesystem::path& map)
{
  constexpr double kMetres = 0.01, kRadians = 0.002;
  for (std::size_t i = 0; i < lidars.size(); ++i)
  {
    const Vector6d apart = boxMinus(lidars[i].body_T_sensor, lidar.body_T_sensor);
    if (lidars[i].name == lidar.name && apart.head<3>().norm() < kMetres && apart.tail<3>().norm() < kRadians)
      return static_cast<std::uint8_t>(i);
  }
  throw UsageError(
      fmt::format("--grow: {} has a lidar '{}' that this recording has not, or has elsewhere on the machine",
                  map.string(), lidar.name));
}
}  // namespace

std::vector<std::string> SlamFiles::names(const OutputOptions& output)
{
  std::vector<std::string> names{"trajectory.tum", "trajectory_imu.tum", "trajectory.csv"};
  for (std::string& name : SlamMaps::names()) names.push_back(std::move(name));
  if (!output.dense_map.empty()) names.push_back(DenseMap::nameOf(output));
  names.emplace_back("summary.json");
  return names;
}

SlamFiles::SlamFiles(const std::filesystem::path& folder, const std::vector<RecordedLidar>& lidars,
                     const OutputOptions& output)
  : folder_(created(folder)), lidars_(lidars), output_(output), csv_(folder / "trajectory.csv")
{
  csv_.stream() << "stamp_ns,health,registration,overlap,score,iterations,points,keyframe,scan_complete,imu_complete,"
                   "surprise,trusted,recovered,sigma_x,sigma_y,sigma_z,sigma_rx,sigma_ry,sigma_rz,correction_m,"
                   "correction_deg,in_map,mark\n";
  begin();
}

/** All that has poses; an earlier file of the name is given up. */
void SlamFiles::begin()
{
  path_.clear();
  trajectory_.reset(), trajectory_imu_.reset(), maps_.reset(), dense_map_.reset();
  trajectory_.emplace(folder_ / "trajectory.tum");
  trajectory_imu_.emplace(folder_ / "trajectory_imu.tum");
  if (output_.maps) maps_.emplace(folder_, lidars_, cloudClassFromName(output_.keyframe_class, "keyframe_class"));
  if (!output_.dense_map.empty()) dense_map_.emplace(folder_, output_);
}

void SlamFiles::grow(const std::filesystem::path& keyframes, const std::vector<MountedLidar>& lidars)
{
  EarlierKeyframes earlier{keyframes, {}};
  for (const MountedLidar& lidar : lidars) earlier.sensor_ids.push_back(sameLidar(lidar, lidars_, keyframes));
  earlier_ = earlier;
}

/** At the end: live lidars do not wait for a map to be read. */
void SlamFiles::addEarlierKeyframes()
{
  const SimpleMapReader reader(earlier_->file);
  for (std::size_t i = 0; i < reader.size(); ++i)
  {
    Keyframe keyframe = reader.keyframe(i);
    for (std::uint8_t& id : keyframe.points.sensor_id) id = earlier_->sensor_ids[id];
    maps_->addEarlier({std::move(keyframe), reader.covariance(i)});
  }
}

void SlamFiles::add(const StateEstimate& e)
{
  if (e.in_map && !std::exchange(in_map_, true)) begin();
  extendPath({e.stamp, e.map_T_body});
  trajectory_->add({e.stamp, e.map_T_body});
  for (const StampedPose& pose : e.since_last) trajectory_imu_->add(pose);

  const RegistrationResult none;
  const RegistrationResult& r = e.registration ? *e.registration : none;
  const Vector6d sigma = e.since_start.diagonal().cwiseSqrt();
  fmt::print(csv_.stream(),
             "{},{},{},{:.4f},{:.6f},{},{},{:d},{:d},{:d},{:.2f},{:d},{:d},{:.3e},{:.4f},{:.4f},{:d},{}\n",
             nanoseconds(e.stamp), toString(e.health), e.registration ? toString(r.outcome) : "none", r.overlap,
             r.score, r.iterations, e.cloud.size(), e.keyframe.has_value(), e.scan_complete, e.imu_complete,
             e.mahalanobis, e.trusted, e.recovered, fmt::join(sigma.begin(), sigma.end(), ","),
             e.correction.head<3>().norm(), 180 / M_PI * e.correction.tail<3>().norm(), e.in_map, marksUntil(e.stamp));
  for (TumWriter* writer : {&*trajectory_, &*trajectory_imu_}) writer->flush();
  csv_.flush();
  if (maps_ && e.keyframe)
    maps_->add({*e.keyframe, e.since_start, imuOf(e)}, {e.stamp, e.map_restarted, e.keyframe_covariance});
  if (dense_map_) dense_map_->add(e);
}

std::string SlamFiles::marksUntil(Timestamp stamp)
{
  std::vector<std::string> texts;
  for (; !marks_.empty() && marks_.front().stamp <= stamp; marks_.pop_front())
    texts.push_back(csvText(marks_.front().text));
  return fmt::format("{}", fmt::join(texts, "; "));
}

void SlamFiles::extendPath(const StampedPose& pose)
{
  constexpr double kApart = 0.05;  // m
  if (!path_.empty()) path_length_ += distance(path_.back(), pose);
  const bool near = path_.size() > 1 && distance(path_[path_.size() - 2], path_.back()) < kApart;
  if (near)
    path_.back() = pose;
  else
    path_.push_back(pose);
}

void SlamFiles::closePoses()
{
  trajectory_->close();
  trajectory_imu_->close();
  csv_.commit();
}

/** The failure may have been that a disk is full. */
void SlamFiles::closePosesAfterFailure()
{
  trajectory_->closeAfterFailure();
  trajectory_imu_->closeAfterFailure();
  csv_.commitLines();
}

RunSummary SlamFiles::close(RunSummary summary)
{
  if (summary.error.empty())
    closePoses();
  else
    closePosesAfterFailure();
  if (maps_ && earlier_ && in_map_) addEarlierKeyframes();
  if (maps_) maps_->close(path_, summary);
  if (dense_map_) dense_map_->close(summary);
  summary.path_length = path_length_;
  summary.peak_memory = peakMemory();
  writeSummary(folder_ / "summary.json", summary);
  return summary;
}
}  // namespace scanloom
