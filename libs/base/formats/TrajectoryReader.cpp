#include "base/formats/TrajectoryReader.h"

#include "base/formats/SecondsText.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;
constexpr std::size_t kKittiNumbers = 12;

bool holdsData(const std::string& line)
{
  const auto first = line.find_first_not_of(" \t\r");
  return first != std::string::npos && line[first] != '#';
}

/** Calls parse for each line with data; what it throws is prefixed with file and line. */
void forEachLine(const Path& path, const std::function<void(const std::string&)>& parse)
{
  std::ifstream file(path);
  if (!file) throw std::invalid_argument(fmt::format("cannot read the trajectory '{}'", path.string()));
  std::string line;
  for (int number = 1; std::getline(file, line); ++number)
    if (holdsData(line)) try
      {
        parse(line);
      }
      catch (const std::invalid_argument& error)
      {
        throw std::invalid_argument(fmt::format("{}:{}: {}", path.string(), number, error.what()));
      }
}

std::string firstLine(const Path& path)
{
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (holdsData(line)) return line;
  return {};
}

void append(Trajectory& trajectory, const StampedPose& pose)
{
  if (!trajectory.empty() && pose.stamp <= trajectory.back().stamp)
    throw std::invalid_argument(fmt::format("stamp {} is not after {}: sort the file by time", secondsText(pose.stamp),
                                            secondsText(trajectory.back().stamp)));
  trajectory.push_back(pose);
}

StampedPose parseEuroc(std::string line)
{
  const auto mistake = [&]
  { return std::invalid_argument(fmt::format("expected 'ns,x,y,z,qw,qx,qy,qz' with a unit quaternion: '{}'", line)); };
  std::string words_of_line = line;
  std::replace(words_of_line.begin(), words_of_line.end(), ',', ' ');
  std::istringstream words(words_of_line);
  std::int64_t stamp = 0;
  Eigen::Vector3d t;
  Eigen::Quaterniond q;
  if (!(words >> stamp >> t.x() >> t.y() >> t.z() >> q.w() >> q.x() >> q.y() >> q.z())) throw mistake();
  if (std::abs(q.norm() - 1.0) > 1e-3 || !t.allFinite()) throw mistake();
  if (stamp <= -kFarthestStamp.count() || stamp >= kFarthestStamp.count())
    throw std::invalid_argument(fmt::format("stamp {} ns is not between 1827 and 2112", stamp));
  return {fromNanoseconds(stamp), Rigid{q.normalized(), t}};
}

Rigid parseKitti(const std::string& line)
{
  std::istringstream words(line);
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  for (std::size_t i = 0; i < kKittiNumbers; ++i)
    words >> matrix(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4));
  std::string surplus;
  if (!words || words >> surplus || !matrix.allFinite())
    throw std::invalid_argument(fmt::format("expected twelve numbers: '{}'", line));
  return Rigid::fromMatrix(matrix);
}

Timestamp parseStamp(const std::string& line)
{
  const auto stamp = parseSeconds(line.substr(0, line.find_last_not_of(" \t\r") + 1));
  if (!stamp) throw std::invalid_argument(fmt::format("expected a stamp in s: '{}'", line));
  return *stamp;
}

Path timesBeside(const Path& poses)
{
  const std::array<Path, 2> names{poses.parent_path() / (poses.stem().string() + "_times.txt"),
                                  poses.parent_path() / "times.txt"};
  for (const Path& name : names)
    if (std::filesystem::exists(name)) return name;
  throw std::invalid_argument(fmt::format("{}: KITTI's poses have no stamps, and there is neither {} nor {}",
                                          poses.string(), names[0].string(), names[1].string()));
}

std::size_t wordsOf(const std::string& line)
{
  std::istringstream words(line);
  std::string word;
  std::size_t count = 0;
  while (words >> word) ++count;
  return count;
}
}  // namespace

Trajectory readEuroc(const Path& path)
{
  Trajectory trajectory;
  forEachLine(path, [&](const std::string& line) { append(trajectory, parseEuroc(line)); });
  return trajectory;
}

Trajectory readKitti(const Path& poses, const Path& times)
{
  std::vector<Timestamp> stamps;
  forEachLine(times, [&](const std::string& line) { stamps.push_back(parseStamp(line)); });
  Trajectory trajectory;
  forEachLine(poses,
              [&](const std::string& line)
              {
                if (trajectory.size() == stamps.size())
                  throw std::invalid_argument(fmt::format("{} has only {} stamps", times.string(), stamps.size()));
                append(trajectory, {stamps[trajectory.size()], parseKitti(line)});
              });
  if (trajectory.size() != stamps.size())
    throw std::invalid_argument(fmt::format("{}: {} poses, but {} stamps in {}", poses.string(), trajectory.size(),
                                            stamps.size(), times.string()));
  return trajectory;
}

bool isEuroc(const Path& path)
{
  const std::string line = firstLine(path);
  const auto comma = line.find(',');
  constexpr std::size_t kLeastDigits = 12;  // 1000 s: what is shorter is seconds
  return comma != std::string::npos && comma >= kLeastDigits &&
         line.substr(0, comma).find_first_not_of("0123456789") == std::string::npos;
}

Trajectory readTrajectory(const Path& path)
{
  if (isEuroc(path)) return readEuroc(path);
  if (wordsOf(firstLine(path)) == kKittiNumbers) return readKitti(path, timesBeside(path));
  return readTum(path);
}
}  // namespace scanloom
