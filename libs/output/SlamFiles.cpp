#include "output/SlamFiles.h"

#include <fmt/ostream.h>

#include <cmath>

namespace scanloom
{
namespace
{
std::vector<MountedLidar> mounted(const std::vector<RecordedLidar>& lidars)
{
  std::vector<MountedLidar> result;
  for (const RecordedLidar& lidar : lidars) result.push_back({lidar.name, lidar.body_T_sensor});
  return result;
}

std::vector<Rigid> originsOf(const std::vector<RecordedLidar>& lidars)
{
  std::vector<Rigid> origins;
  for (const RecordedLidar& lidar : lidars) origins.push_back(lidar.body_T_sensor);
  return origins;
}

const std::filesystem::path& created(const std::filesystem::path& folder)
{
  std::filesystem::create_directories(folder);
  return folder;
}

double lengthOf(const Trajectory& poses)
{
  double length = 0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    length += (poses[i].map_T_body.translation - poses[i - 1].map_T_body.translation).norm();
  return length;
}
}  // namespace

std::vector<std::string> SlamFiles::names()
{
  return {
      "trajectory.tum", "trajectory_imu.tum", "trajectory.csv", "keyframes.simplemap", "map.ply", "map.bt", "map.ot",
      "map.png",        "summary.json"};
}

SlamFiles::SlamFiles(const std::filesystem::path& folder, const std::vector<RecordedLidar>& lidars,
                     const OctoMapOptions& octomap)
  : folder_(created(folder)),
    trajectory_(folder / "trajectory.tum"),
    trajectory_imu_(folder / "trajectory_imu.tum"),
    csv_(folder / "trajectory.csv"),
    ply_(folder / "map.ply"),
    simple_map_(mounted(lidars)),
    octomap_(octomap, originsOf(lidars)),
    picture_(MapPictureOptions{}),
    thread_([this] { drawMaps(); })
{
  csv_.stream() << "stamp_ns,health,registration,overlap,score,iterations,points,keyframe,scan_complete,imu_complete,"
                   "surprise,trusted,recovered\n";
}

void SlamFiles::add(const StateEstimate& e)
{
  poses_.push_back({e.stamp, e.map_T_body});
  trajectory_.add(poses_.back());
  for (const StampedPose& pose : e.since_last) trajectory_imu_.add(pose);

  const RegistrationResult none;
  const RegistrationResult& r = e.registration ? *e.registration : none;
  fmt::print(csv_.stream(), "{},{},{},{:.4f},{:.6f},{},{},{:d},{:d},{:d},{:.2f},{:d},{:d}\n", nanoseconds(e.stamp),
             toString(e.health), e.registration ? toString(r.outcome) : "none", r.overlap, r.score, r.iterations,
             e.points, e.keyframe.has_value(), e.scan_complete, e.imu_complete, e.surprise, e.trusted, e.recovered);
  for (TumWriter* writer : {&trajectory_, &trajectory_imu_}) writer->flush();
  csv_.stream().flush();
  if (e.keyframe) enqueue(*e.keyframe);
}

void SlamFiles::enqueue(Keyframe keyframe)
{
  constexpr std::size_t kMostWaiting = 8;
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return keyframes_.size() < kMostWaiting || error_; });
  if (error_) std::rethrow_exception(error_);
  keyframes_.push_back(std::move(keyframe));
  changed_.notify_all();
}

void SlamFiles::drawMaps()
{
  try
  {
    while (true)
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return !keyframes_.empty() || no_more_; });
      if (keyframes_.empty()) return;
      const Keyframe keyframe = std::move(keyframes_.front());
      keyframes_.pop_front();
      changed_.notify_all();
      lock.unlock();
      addKeyframe(keyframe);
    }
  }
  catch (...)
  {
    const std::lock_guard lock(mutex_);
    error_ = std::current_exception();
    changed_.notify_all();
  }
}

void SlamFiles::finishMaps()
{
  {
    const std::lock_guard lock(mutex_);
    no_more_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

SlamFiles::~SlamFiles() { finishMaps(); }

void SlamFiles::addKeyframe(const Keyframe& keyframe)
{
  times_.measure("output.ply", [&] { ply_.add(keyframe.points, keyframe.stamp, keyframe.map_T_body); });
  times_.measure("output.simplemap", [&] { simple_map_.add(keyframe); });
  times_.measure("output.octomap", [&] { octomap_.add(keyframe); });
  times_.measure("output.picture", [&] { picture_.add(keyframe); });
}

void SlamFiles::close(RunSummary summary)
{
  finishMaps();
  if (error_) std::rethrow_exception(error_);
  trajectory_.close();
  trajectory_imu_.close();
  csv_.commit();
  ply_.close();
  times_.measure("output.write",
                 [&]
                 {
                   simple_map_.write(folder_ / "keyframes.simplemap");
                   std::move(octomap_).write(folder_ / "map.bt", folder_ / "map.ot");
                   if (!poses_.empty()) picture_.write(folder_ / "map.png", poses_, "map at breast height");
                 });
  summary.path_length = lengthOf(poses_);
  summary.counts["map_points"] = ply_.size();
  for (const auto& [stage, time] : times_.stages()) summary.stages[stage] = time;
  summary.peak_memory = peakMemory();
  writeSummary(folder_ / "summary.json", summary);
}
}  // namespace scanloom
