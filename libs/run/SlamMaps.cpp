#include "run/SlamMaps.h"

namespace scanloom
{
namespace
{
constexpr std::size_t kMostWaiting = 8;
}  // namespace

std::vector<std::string> SlamMaps::names() { return {"keyframes.simplemap", "map.ply", "map.bt", "map.ot", "map.png"}; }

SlamMaps::SlamMaps(const std::filesystem::path& folder, const std::vector<RecordedLidar>& lidars,
                   const OctoMapOptions& octomap)
  : folder_(folder),
    ply_(folder / "map.ply"),
    simple_map_(mountedLidars(lidars)),
    octomap_(octomap, posesOf(mountedLidars(lidars))),
    picture_(MapPictureOptions{}),
    queue_(kMostWaiting),
    drawn_(std::async(std::launch::async, [this] { draw(); }))
{
}

SlamMaps::~SlamMaps() { queue_.end(); }

void SlamMaps::add(Keyframe keyframe)
{
  if (!queue_.push(std::move(keyframe))) drawn_.get();
}

void SlamMaps::draw()
{
  try
  {
    while (const std::optional<Keyframe> keyframe = queue_.pop()) addToAll(*keyframe);
  }
  catch (...)
  {
    queue_.close();
    throw;
  }
}

void SlamMaps::addToAll(const Keyframe& keyframe)
{
  times_.measure("output.ply", [&] { ply_.add(keyframe.points, keyframe.stamp, keyframe.map_T_body); });
  times_.measure("output.simplemap", [&] { simple_map_.add(keyframe); });
  times_.measure("output.octomap", [&] { octomap_.add(keyframe); });
  times_.measure("output.picture", [&] { picture_.add(keyframe); });
}

void SlamMaps::close(const Trajectory& path, RunSummary& summary)
{
  queue_.end();
  drawn_.get();
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
