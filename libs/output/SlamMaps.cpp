#include "output/SlamMaps.h"

namespace scanloom
{
std::vector<std::string> SlamMaps::names() { return {"keyframes.simplemap", "map.ply", "map.bt", "map.ot", "map.png"}; }

SlamMaps::SlamMaps(const std::filesystem::path& folder, const std::vector<RecordedLidar>& lidars,
                   const OctoMapOptions& octomap)
  : folder_(folder),
    ply_(folder / "map.ply"),
    simple_map_(mountedLidars(lidars)),
    octomap_(octomap, posesOf(mountedLidars(lidars))),
    picture_(MapPictureOptions{}),
    thread_([this] { draw(); })
{
}

void SlamMaps::add(Keyframe keyframe)
{
  constexpr std::size_t kMostWaiting = 8;
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return keyframes_.size() < kMostWaiting || error_; });
  if (error_) std::rethrow_exception(error_);
  keyframes_.push_back(std::move(keyframe));
  changed_.notify_all();
}

void SlamMaps::draw()
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
      addToAll(keyframe);
    }
  }
  catch (...)
  {
    const std::lock_guard lock(mutex_);
    error_ = std::current_exception();
    changed_.notify_all();
  }
}

void SlamMaps::finish()
{
  {
    const std::lock_guard lock(mutex_);
    no_more_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

SlamMaps::~SlamMaps() { finish(); }

void SlamMaps::addToAll(const Keyframe& keyframe)
{
  times_.measure("output.ply", [&] { ply_.add(keyframe.points, keyframe.stamp, keyframe.map_T_body); });
  times_.measure("output.simplemap", [&] { simple_map_.add(keyframe); });
  times_.measure("output.octomap", [&] { octomap_.add(keyframe); });
  times_.measure("output.picture", [&] { picture_.add(keyframe); });
}

void SlamMaps::close(const Trajectory& path, RunSummary& summary)
{
  finish();
  if (error_) std::rethrow_exception(error_);
  ply_.close();
  times_.measure("output.write",
                 [&]
                 {
                   simple_map_.write(folder_ / "keyframes.simplemap");
                   std::move(octomap_).write(folder_ / "map.bt", folder_ / "map.ot");
                   if (!path.empty()) picture_.write(folder_ / "map.png", path, "map at breast height");
                 });
  summary.counts["map_points"] = ply_.size();
  for (const auto& [stage, time] : times_.stages()) summary.stages[stage] = time;
}
}  // namespace scanloom
