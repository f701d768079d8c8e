#include "run/run/internal/SlamMaps.h"

#include "run/run/internal/reasonOf.h"

#include <fmt/format.h>

#include <utility>

namespace scanloom
{
namespace
{
constexpr std::size_t kMostWaitingMaps = 8;
constexpr const char *kPly = "map.ply", *kSimpleMap = "keyframes.simplemap", *kPicture = "map.png";
}  // namespace

std::vector<std::string> SlamMaps::names() { return {"keyframes.simplemap", "keyframes.csv", "map.ply", "map.png"}; }

SlamMaps::SlamMaps(const std::filesystem::path& folder, const std::vector<RecordedLidar>& lidars,
                   CloudClass of_keyframes)
  : folder_(folder),
    ply_(folder / "map.ply"),
    table_(folder / "keyframes.csv"),
    simple_map_(folder / kSimpleMap, mountedLidars(lidars), of_keyframes),
    picture_(MapPictureOptions{}),
    queue_(kMostWaitingMaps),
    drawn_(std::async(std::launch::async, [this] { draw(); }))
{
}

SlamMaps::~SlamMaps() { queue_.end(); }

void SlamMaps::add(MeasuredKeyframe keyframe, const KeyframeRow& row)
{
  table_.add(row);
  addEarlier(std::move(keyframe));
}

void SlamMaps::addEarlier(MeasuredKeyframe keyframe)
{
  if (!queue_.push(std::move(keyframe))) drawn_.get();
}

void SlamMaps::draw()
{
  try
  {
    while (const std::optional<MeasuredKeyframe> keyframe = queue_.pop()) addToAll(*keyframe);
  }
  catch (...)
  {
    queue_.close();
    throw;
  }
}

void SlamMaps::attempt(const std::string& files, const std::function<void()>& step)
{
  if (failures_.count(files) > 0) return;
  try
  {
    step();
  }
  catch (const std::exception& error)
  {
    failures_[files] = reasonOf(error);
  }
}

void SlamMaps::addToAll(const MeasuredKeyframe& measured)
{
  const Keyframe& keyframe = measured.keyframe;
  const auto add = [&](const char* stage, const char* files, const std::function<void()>& step)
  { attempt(files, [&] { times_.measure(stage, step); }); };
  add("output.ply", kPly, [&] { ply_.add(keyframe.points, keyframe.stamp, keyframe.map_T_body); });
  add("output.simplemap", kSimpleMap, [&] { simple_map_.add(measured); });
  add("output.picture", kPicture, [&] { picture_.add(keyframe); });
}

void SlamMaps::writeAll(const Trajectory& path)
{
  attempt(kPly, [&] { ply_.close(); });
  attempt(kSimpleMap, [&] { table_.close(); });
  attempt(kSimpleMap, [&] { simple_map_.close(); });
  if (path.empty()) return;
  attempt(kPicture, [&] { picture_.write(folder_ / kPicture, {path}, "map at breast height"); });
}

void SlamMaps::close(const Trajectory& path, RunSummary& summary)
{
  queue_.end();
  drawn_.get();
  times_.measure("output.write", [&] { writeAll(path); });
  summary.counts["map_points"] = ply_.size();
  for (const auto& [stage, time] : times_.stages()) summary.stages[stage] = time;
  for (const auto& [files, reason] : failures_)
    summary.error += fmt::format("{}without {}: {}", summary.error.empty() ? "" : "; ", files, reason);
}
}  // namespace scanloom
