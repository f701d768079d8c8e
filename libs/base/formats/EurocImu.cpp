#include "base/formats/EurocImu.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace scanloom
{
namespace
{
constexpr std::string_view kBlanks = " \t\r";
constexpr std::string_view kHeading =
    "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
    "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]";

std::string_view trimmed(std::string_view text)
{
  const auto begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

template <typename Number>
std::optional<Number> parse(std::string_view text)
{
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::vector<std::string_view> cellsOf(std::string_view line)
{
  std::vector<std::string_view> cells;
  for (std::size_t comma; (comma = line.find(',')) != std::string_view::npos; line.remove_prefix(comma + 1))
    cells.push_back(trimmed(line.substr(0, comma)));
  cells.push_back(trimmed(line));
  return cells;
}

std::optional<ImuSample> sampleFrom(const std::vector<std::string_view>& cells)
{
  if (cells.size() != 7) return std::nullopt;
  const auto stamp = parse<std::int64_t>(cells[0]);
  if (!stamp) return std::nullopt;

  ImuSample sample{fromNanoseconds(*stamp), {}, {}};
  for (int i = 0; i < 6; ++i)
  {
    const auto value = parse<double>(cells[static_cast<std::size_t>(i) + 1]);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    (i < 3 ? sample.gyro[i] : sample.accel[i - 3]) = *value;
  }
  return sample;
}
}  // namespace

std::vector<ImuSample> readEurocImu(const std::filesystem::path& path)
{
  std::ifstream file(path);
  if (!file) throw std::runtime_error(fmt::format("{}: IMU file cannot be opened", path.string()));

  std::vector<ImuSample> samples;
  std::string line;
  bool heading_may_come = true;
  for (int number = 1; std::getline(file, line); ++number)
  {
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;

    const auto cells = cellsOf(text);
    const auto sample = sampleFrom(cells);
    const bool is_heading = heading_may_come && !parse<double>(cells.front());
    heading_may_come = false;
    if (is_heading) continue;
    if (!sample)
      throw std::runtime_error(
          fmt::format("{}:{}: '{}' must be 'ns,gyro x,y,z,accel x,y,z': an integer and six finite numbers",
                      path.string(), number, text));
    if (!samples.empty() && sample->stamp <= samples.back().stamp)
      throw std::runtime_error(
          fmt::format("{}:{}: stamp {} ns is not after {} ns of the reading before: sort the file by its first column",
                      path.string(), number, nanoseconds(sample->stamp), nanoseconds(samples.back().stamp)));
    samples.push_back(*sample);
  }
  return samples;
}

EurocImuWriter::EurocImuWriter(const std::filesystem::path& path) : path_(path), file_(path)
{
  file_ << kHeading << '\n';
}

void EurocImuWriter::add(const ImuSample& s)
{
  file_ << fmt::format("{},{},{},{},{},{},{}\n", nanoseconds(s.stamp), s.gyro.x(), s.gyro.y(), s.gyro.z(), s.accel.x(),
                       s.accel.y(), s.accel.z());
}

void EurocImuWriter::close()
{
  file_.close();
  if (!file_) throw std::runtime_error(fmt::format("{}: IMU file cannot be written", path_.string()));
}
}  // namespace scanloom
