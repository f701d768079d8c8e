#include "base/formats/TrajectoryWriter.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;

Path timesOf(const Path& poses) { return poses.parent_path() / (poses.stem().string() + "_times.txt"); }
}  // namespace

bool isTrajectoryName(const Path& path)
{
  const Path ending = path.extension();
  return ending == ".tum" || ending == ".csv" || ending == ".txt";
}

std::vector<Path> trajectoryFiles(const Path& path)
{
  if (path.extension() == ".txt") return {path, timesOf(path)};
  return {path};
}

void writeTrajectory(const Path& path, const Trajectory& trajectory)
{
  const Path ending = path.extension();
  if (ending == ".tum")
    writeTum(path, trajectory);
  else if (ending == ".csv")
    writeEuroc(path, trajectory);
  else if (ending == ".txt")
    writeKitti(path, timesOf(path), trajectory);
  else
    throw std::invalid_argument(
        fmt::format("{}: a trajectory's name ends in .tum, .csv (EuRoC) or .txt (KITTI)", path.string()));
}
}  // namespace scanloom
