#include "base/formats/ImuCsv.h"

#include "base/core/Statistics.h"
#include "base/core/Text.h"
#include "base/core/parseWhole.h"
#include "base/formats/SecondsText.h"
#include "base/formats/StampUnit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace scanloom
{
namespace
{
constexpr std::string_view kHeading =
    "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
    "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]";

std::vector<std::string_view> cellsOf(std::string_view line)
{
  std::vector<std::string_view> cells;
  for (std::size_t comma; (comma = line.find(',')) != std::string_view::npos; line.remove_prefix(comma + 1))
    cells.push_back(trimmed(line.substr(0, comma)));
  cells.push_back(trimmed(line));
  return cells;
}

bool isSkipped(std::string_view text) { return text.empty() || text.front() == '#'; }

/** Where the numbers of a sample stand, and what makes rad/s and m/s2 of them. */
struct Columns
{
  std::size_t stamp = 0;
  std::array<std::size_t, 3> gyro{1, 2, 3}, accel{4, 5, 6};
  double gyro_scale = 1, accel_scale = 1;
  std::size_t count = 7;
};

constexpr double kPerDegree = 3.14159265358979323846 / 180, kStandardGravity = 9.80665;

bool holds(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

/** A name without its unit, and the unit: "w_x [deg/s]", "gyro_x (deg/s)". */
std::pair<std::string, std::string> nameAndUnit(std::string_view cell)
{
  const std::string lower = lowerCase(cell);
  const std::size_t unit = lower.find_first_of("[(");
  std::string name(trimmed(std::string_view(lower).substr(0, unit)));
  name.erase(0, name.find_first_not_of("#%"));
  return {name, unit == std::string::npos ? "" : lower.substr(unit)};
}

bool isGyro(const std::string& name)
{
  return holds(name, "angular_vel") || holds(name, "gyr") || holds(name, "omega") || name.rfind('w', 0) == 0;
}

bool isAccel(const std::string& name) { return holds(name, "acc") || name.rfind('a', 0) == 0; }

bool isStamp(const std::string& name)
{
  return name == "t" || holds(name, "time") || (name.size() >= 5 && name.compare(name.size() - 5, 5, "stamp") == 0);
}

/** Nothing if the names are not those of a stamp, three of a gyroscope and three of an accelerometer. */
std::optional<Columns> columnsOf(const std::vector<std::string_view>& heading)
{
  std::vector<std::size_t> stamps;
  std::array<std::vector<std::size_t>, 3> gyro, accel;
  Columns columns;
  for (std::size_t i = 0; i < heading.size(); ++i)
  {
    const auto [name, unit] = nameAndUnit(heading[i]);
    if (name.empty() || holds(name, "orientation") || holds(name, "covariance")) continue;
    const auto axis = static_cast<std::size_t>(name.back() - 'x');
    if (isStamp(name))
      stamps.push_back(i);
    else if (axis < 3 && isGyro(name))
    {
      gyro[axis].push_back(i);
      if (holds(unit, "deg")) columns.gyro_scale = kPerDegree;
    }
    else if (axis < 3 && isAccel(name))
    {
      accel[axis].push_back(i);
      if (unit == "[g]" || unit == "(g)") columns.accel_scale = kStandardGravity;
    }
  }
  if (stamps.empty()) return std::nullopt;
  columns.stamp = stamps.back();  // that of the header follows the time of reception
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (gyro[axis].size() != 1 || accel[axis].size() != 1) return std::nullopt;
    columns.gyro[axis] = gyro[axis].front();
    columns.accel[axis] = accel[axis].front();
  }
  columns.count = heading.size();
  return columns;
}

/** A number that is to become a stamp when its unit is known. */
struct RawStamp
{
  std::int64_t integer = 0;
  std::optional<Timestamp> seconds;  // it has a decimal point
};

std::optional<RawStamp> stampFrom(std::string_view text)
{
  if (const auto integer = parseWhole<std::int64_t>(text))
  {
    const bool is_far = *integer < -kFarthestStamp.count() || *integer > kFarthestStamp.count();
    return is_far ? std::nullopt : std::optional(RawStamp{*integer, std::nullopt});
  }
  if (const auto seconds = parseSeconds(std::string(text))) return RawStamp{0, seconds};
  return std::nullopt;
}

struct RawSample
{
  RawStamp stamp;
  ImuSample sample;  // but for its stamp
  int line = 0;
};

std::optional<RawSample> sampleFrom(const std::vector<std::string_view>& cells, const Columns& columns)
{
  if (cells.size() != columns.count) return std::nullopt;
  const auto stamp = stampFrom(cells[columns.stamp]);
  if (!stamp) return std::nullopt;
  RawSample raw{*stamp, {}, 0};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto gyro = parseWhole<double>(cells[columns.gyro[axis]]),
               accel = parseWhole<double>(cells[columns.accel[axis]]);
    if (!gyro || !accel || !std::isfinite(*gyro) || !std::isfinite(*accel)) return std::nullopt;
    raw.sample.gyro[static_cast<Eigen::Index>(axis)] = *gyro * columns.gyro_scale;
    raw.sample.accel[static_cast<Eigen::Index>(axis)] = *accel * columns.accel_scale;
  }
  return raw;
}

/** Of integer stamps: that in which an IMU's pace comes out; nanoseconds if none does. */
StampUnit unitOf(const std::vector<RawSample>& samples)
{
  std::vector<std::int64_t> intervals;
  for (std::size_t i = 1; i < samples.size(); ++i)
    if (const std::int64_t d = samples[i].stamp.integer - samples[i - 1].stamp.integer; d > 0) intervals.push_back(d);
  constexpr StampUnit kNanoseconds{"ns", 1};
  if (intervals.empty()) return kNanoseconds;
  return unitByPace(static_cast<double>(upperMedian(std::move(intervals))), 200us, 100ms).value_or(kNanoseconds);
}

/** Without names of columns: what seven numbers are follows from the accelerometer, which weighs about 1 g. */
bool isLineOfImu(const std::vector<std::string_view>& cells)
{
  const auto raw = sampleFrom(cells, {});
  if (!raw) return false;
  constexpr std::size_t kDigitsOfNanoseconds = 10;  // of at least 1 s
  if (!raw->stamp.seconds && cells.front().size() >= kDigitsOfNanoseconds) return true;
  return std::abs(raw->sample.accel.norm() - kStandardGravity) < 0.5 * kStandardGravity;
}

struct Table
{
  Columns columns;
  std::vector<RawSample> samples;
};

/** Throws std::runtime_error with file and line. */
Table readTable(const std::filesystem::path& path)
{
  std::ifstream file(path);
  if (!file) throw std::runtime_error(fmt::format("{}: IMU file cannot be opened", path.string()));
  Table table;
  bool heading_may_come = true;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number)
  {
    const std::string_view text = trimmed(line);
    const auto cells = cellsOf(text);
    if (const auto named = heading_may_come ? columnsOf(cells) : std::nullopt) table.columns = *named;
    if (isSkipped(text)) continue;
    const bool is_heading = heading_may_come && !parseWhole<double>(cells.front());
    heading_may_come = false;
    if (is_heading) continue;
    const auto sample = sampleFrom(cells, table.columns);
    if (!sample)
      throw std::runtime_error(
          fmt::format("{}:{}: '{}' must be 'ns,gyro x,y,z,accel x,y,z': an integer and six finite numbers, or what a "
                      "heading names",
                      path.string(), number, text));
    table.samples.push_back(*sample);
    table.samples.back().line = number;
  }
  return table;
}

std::vector<std::string> conclusionsOf(const Table& table, const StampUnit& unit)
{
  std::vector<std::string> notes;
  if (!table.samples.empty() && table.samples.front().stamp.seconds)
    notes.emplace_back("stamps have a decimal point: taken as s");
  else if (unit.nanoseconds != 1)
    notes.push_back(fmt::format("stamps taken as {}", unit.name));
  if (table.columns.gyro_scale != 1) notes.emplace_back("gyro converted from deg/s");
  if (table.columns.accel_scale != 1) notes.emplace_back("accel converted from g");
  return notes;
}
}  // namespace

bool beginsLikeImuCsv(std::string_view text)
{
  while (!text.empty())
  {
    const std::string_view line = trimmed(text.substr(0, text.find('\n')));
    const auto cells = cellsOf(line);
    if (columnsOf(cells)) return true;
    if (!isSkipped(line) && parseWhole<double>(cells.front())) return isLineOfImu(cells);
    if (!isSkipped(line)) return false;
    text.remove_prefix(std::min(text.size(), std::min(text.find('\n'), text.size() - 1) + 1));
  }
  return false;
}

ImuOfFile readImuCsv(const std::filesystem::path& path)
{
  const Table table = readTable(path);
  const StampUnit unit = unitOf(table.samples);
  std::vector<ImuSample> samples;
  for (const RawSample& raw : table.samples)
  {
    const std::optional<Timestamp> stamp = unit.stampOf(raw.stamp.integer);
    if (!stamp)
      throw std::runtime_error(fmt::format("{}:{}: stamp {} {} is not between 1827 and 2112", path.string(), raw.line,
                                           raw.stamp.integer, unit.name));
    ImuSample sample = raw.sample;
    sample.stamp = raw.stamp.seconds.value_or(*stamp);
    if (!samples.empty() && sample.stamp < samples.back().stamp)
      throw std::runtime_error(
          fmt::format("{}:{}: stamp {} ns is not after {} ns of the reading before: sort the file by its stamps",
                      path.string(), raw.line, nanoseconds(sample.stamp), nanoseconds(samples.back().stamp)));
    samples.push_back(sample);
  }
  ImuOfFile imu{oneOfEachStamp(samples), conclusionsOf(table, unit)};
  for (std::string& note : imu.notes) note = fmt::format("{}: {}", path.string(), note);
  return imu;
}

ImuCsvWriter::ImuCsvWriter(const std::filesystem::path& path) : path_(path), file_(path) { file_ << kHeading << '\n'; }

void ImuCsvWriter::add(const ImuSample& s)
{
  file_ << fmt::format("{},{},{},{},{},{},{}\n", nanoseconds(s.stamp), s.gyro.x(), s.gyro.y(), s.gyro.z(), s.accel.x(),
                       s.accel.y(), s.accel.z());
}

void ImuCsvWriter::close()
{
  file_.close();
  if (!file_) throw std::runtime_error(fmt::format("{}: IMU file cannot be written", path_.string()));
}
}  // namespace scanloom
