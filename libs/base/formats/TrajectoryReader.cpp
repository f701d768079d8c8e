#include "base/formats/TrajectoryReader.h"

#include "base/core/parseWhole.h"
#include "base/formats/SecondsText.h"
#include "base/formats/StampUnit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;
using Note = std::function<void(const std::string&)>;
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

/** Poses in order; of those with one stamp the first. */
class OrderedPoses
{
 public:
  /** Throws std::invalid_argument if it is before the one before. */
  void add(const StampedPose& pose)
  {
    if (!poses_.empty() && pose.stamp < poses_.back().stamp)
      throw std::invalid_argument(fmt::format("stamp {} is not after {}: sort the file by time",
                                              secondsText(pose.stamp), secondsText(poses_.back().stamp)));
    if (poses_.empty() || pose.stamp != poses_.back().stamp)
      poses_.push_back(pose);
    else
      ++repeated_;
  }

  std::size_t seen() const { return poses_.size() + repeated_; }

  Trajectory finish(const Path& path, const Note& note)
  {
    if (repeated_ > 0 && note)
      note(fmt::format("{}: {} poses have the stamp of the one before: left out", path.string(), repeated_));
    return std::move(poses_);
  }

 private:
  Trajectory poses_;
  std::size_t repeated_ = 0;
};

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
/** In which an integer stamp is a date; nothing for seconds, and for a number that is a date in no unit. */
std::optional<StampUnit> unitOfInteger(const std::string& stamp)
{
  const auto number = parseWhole<std::int64_t>(stamp);
  const std::optional<StampUnit> unit = number ? unitByDate(*number) : std::nullopt;
  return unit && unit->nanoseconds < 1'000'000'000 ? unit : std::nullopt;
}

/** The line with its stamp as seconds. */
std::string inSeconds(const std::string& line, const StampUnit& unit)
{
  std::istringstream words(line);
  std::int64_t stamp = 0;
  std::string rest;
  words >> stamp;
  std::getline(words, rest);
  const std::optional<Timestamp> time = unit.stampOf(stamp);
  return time && stamp >= 0 ? secondsText(*time) + rest : line;
}

Trajectory readEuroc(const Path& path, const Note& note)
{
  OrderedPoses poses;
  forEachLine(path, [&](const std::string& line) { poses.add(parseEuroc(line)); });
  return poses.finish(path, note);
}

Trajectory readKitti(const Path& path, const Path& times, const Note& note)
{
  std::vector<Timestamp> stamps;
  forEachLine(times, [&](const std::string& line) { stamps.push_back(parseStamp(line)); });
  OrderedPoses poses;
  forEachLine(path,
              [&](const std::string& line)
              {
                if (poses.seen() == stamps.size())
                  throw std::invalid_argument(fmt::format("{} has only {} stamps", times.string(), stamps.size()));
                poses.add({stamps[poses.seen()], parseKitti(line)});
              });
  if (poses.seen() != stamps.size())
    throw std::invalid_argument(
        fmt::format("{}: {} poses, but {} stamps in {}", path.string(), poses.seen(), stamps.size(), times.string()));
  return poses.finish(path, note);
}

Trajectory readTum(const Path& path, const Note& note)
{
  const std::string first = firstLine(path);
  const std::size_t begin = first.find_first_not_of(" \t");
  const auto unit = begin == std::string::npos
                        ? std::nullopt
                        : unitOfInteger(first.substr(begin, first.find_first_of(" \t", begin) - begin));
  if (unit && note) note(fmt::format("{}: stamps are no dates in s: taken as {}", path.string(), unit->name));
  OrderedPoses poses;
  forEachLine(path,
              [&](const std::string& line)
              {
                const auto pose = parseTum(unit ? inSeconds(line, *unit) : line);
                if (!pose)
                  throw std::invalid_argument(fmt::format(
                      "expected 't x y z qx qy qz qw', t in s and a unit quaternion, found '{}'", line.substr(0, 80)));
                poses.add(*pose);
              });
  return poses.finish(path, note);
}
}  // namespace

bool isEuroc(const Path& path)
{
  const std::string line = firstLine(path);
  const auto comma = line.find(',');
  constexpr std::size_t kLeastDigits = 12;  // 1000 s: what is shorter is seconds
  return comma != std::string::npos && comma >= kLeastDigits &&
         line.substr(0, comma).find_first_not_of("0123456789") == std::string::npos;
}

Trajectory readTrajectory(const Path& path, const Note& note)
{
  if (isEuroc(path)) return readEuroc(path, note);
  if (wordsOf(firstLine(path)) == kKittiNumbers) return readKitti(path, timesBeside(path), note);
  return readTum(path, note);
}
}  // namespace scanloom
