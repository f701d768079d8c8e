#include "base/positions/TotalStation.h"

#include "base/config/Values.h"
#include "base/core/Text.h"
#include "base/formats/SecondsText.h"
#include "base/formats/TrajectoryReader.h"
#include "base/positions/internal/StationColumns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace scanloom
{
namespace
{
char separatorOf(const std::string& line)
{
  for (const char separator : {';', '\t', ','})
    if (line.find(separator) != std::string::npos) return separator;
  return ' ';
}

std::vector<std::string> fieldsOf(std::string_view line, char separator)
{
  std::vector<std::string> fields;
  for (std::size_t at = 0; at <= line.size();)
  {
    const std::size_t end = std::min(line.find(separator, at), line.size());
    const std::string_view field = trimmed(line.substr(at, end - at));
    if (separator != ' ' || !field.empty()) fields.emplace_back(field);
    at = end + 1;
  }
  return fields;
}

/** The lines of one file, of which the first tells how to read the others. */
class StationLines
{
 public:
  bool geodetic() const { return columns_.geodetic; }

  /** Nothing for a header, a comment or an empty line. */
  std::optional<StampedPosition> measurement(const std::string& line)
  {
    if (trimmed(line).empty()) return std::nullopt;
    if (beginsWith(line, "#"))
    {
      if (!begun_) beginByComment(line.substr(1));
      return std::nullopt;
    }
    if (!begun_ && begin(line)) return std::nullopt;
    std::vector<std::string> fields = fieldsOf(line, separator_);
    if (separator_ != ',')
      for (std::string& field : fields) std::replace(field.begin(), field.end(), ',', '.');
    const auto field = [&](std::size_t i) { return i < fields.size() ? fields[i] : std::string(); };

    const auto stamp = stationTime(field(columns_.stamp), columns_.stamp_unit);
    StampedPosition measured{stamp.value_or(Timestamp{}), {}};
    if (columns_.name) measured.name = field(*columns_.name);
    if (columns_.sigma) measured.sigma = columns_.sigma_unit * sigmaIn(field(*columns_.sigma));
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto a = static_cast<std::size_t>(axis);
      const auto value = parseNumber(field(columns_.position[a]));
      if (!stamp || !value)
        throw std::invalid_argument(
            fmt::format("expected time, x, y and z in the order of the header (without one: "
                        "t,x,y,z in s and m), found '{}'",
                        line.substr(0, 80)));
      measured.position[axis] = *value * columns_.position_unit[a];
    }
    return measured;
  }

 private:
  static double sigmaIn(const std::string& text)
  {
    const auto sigma = parseNumber(text);
    if (!sigma || !(*sigma > 0))
      throw std::invalid_argument(fmt::format("a standard deviation of '{}': must be above 0", text));
    return *sigma;
  }

  /** @return whether the line is a header. */
  bool begin(const std::string& line)
  {
    begun_ = true;
    separator_ = separatorOf(line);
    const std::vector<std::string> fields = fieldsOf(line, separator_);
    std::string first = fields.front();
    std::replace(first.begin(), first.end(), ',', '.');
    if (stationTime(first, 1s)) return false;
    columns_ = StationColumns::ofHeader(fields);
    return true;
  }

  /** Some programs write the names of columns as a comment. */
  void beginByComment(const std::string& comment)
  {
    try
    {
      const char separator = separatorOf(comment);
      columns_ = StationColumns::ofHeader(fieldsOf(comment, separator));
      separator_ = separator;
      begun_ = true;
    }
    catch (const std::invalid_argument&)  // it is any other comment
    {
    }
  }

  bool begun_ = false;
  char separator_ = ',';
  StationColumns columns_;
};
}  // namespace

PositionFile readPositionFile(const std::filesystem::path& path, const std::optional<Geodetic>& origin)
{
  std::ifstream file(path);
  if (!file) throw std::invalid_argument(fmt::format("cannot read the positions of '{}'", path.string()));

  PositionFile positions{{}, std::nullopt};
  PositionTrack& track = positions.track;
  StationLines lines;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) try
    {
      const auto measurement = lines.measurement(line);
      if (!measurement) continue;
      if (!track.empty() && measurement->stamp <= track.back().stamp)
        throw std::invalid_argument(fmt::format("stamp {} is not after {}: sort the file by time",
                                                secondsText(measurement->stamp), secondsText(track.back().stamp)));
      track.push_back(*measurement);
      if (!lines.geodetic()) continue;
      const Eigen::Vector3d& p = measurement->position;
      if (std::abs(p.x()) > 90 || std::abs(p.y()) > 360)
        throw std::invalid_argument(fmt::format("latitude {} or longitude {} is on no earth", p.x(), p.y()));
      const Geodetic at{p.x(), p.y(), p.z()};
      if (!positions.origin) positions.origin = origin.value_or(at);
      track.back().position = eastNorthUp(at, *positions.origin);
    }
    catch (const std::invalid_argument& problem)
    {
      throw std::invalid_argument(fmt::format("{}:{}: {}", path.string(), number, problem.what()));
    }
  return positions;
}

PositionTrack readTotalStation(const std::filesystem::path& path) { return readPositionFile(path).track; }

bool isTotalStation(const std::filesystem::path& reference)
{
  const std::string ending = reference.extension().string();
  return (ending == ".csv" && !isEuroc(reference)) || ending == ".tsv";
}
}  // namespace scanloom
