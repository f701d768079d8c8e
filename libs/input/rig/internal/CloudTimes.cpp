#include "input/rig/internal/CloudTimes.h"

#include "base/core/Statistics.h"
#include "base/formats/SecondsText.h"
#include "base/formats/StampUnit.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace scanloom
{
namespace
{
using Paths = std::vector<std::filesystem::path>;

constexpr Duration kDefaultInterval = 100ms;  // 10 Hz

/** "2011-09-26 13:02:25.951199337", UTC, as in the timestamps.txt of KITTI's raw recordings. */
std::optional<Timestamp> parseDate(const std::string& text)
{
  std::tm date{};
  std::istringstream words(text);
  words >> std::get_time(&date, "%Y-%m-%d %H:%M:%S");
  if (words.fail()) return std::nullopt;
  std::string fraction;
  std::getline(words, fraction);
  const std::optional<Timestamp> after = parseSeconds("0" + fraction);
  if (!after) return std::nullopt;
  return *after + std::chrono::seconds(::timegm(&date));
}

std::optional<std::vector<Timestamp>> stampsOfFile(const std::filesystem::path& path)
{
  std::ifstream file(path);
  if (!file) return std::nullopt;
  std::vector<Timestamp> stamps;
  for (std::string line; std::getline(file, line);)
  {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line.empty()) continue;
    std::optional<Timestamp> stamp = parseSeconds(line);
    if (!stamp) stamp = parseDate(line);
    if (!stamp) throw std::runtime_error(fmt::format("{}: '{}' is no time in s, and no date", path.string(), line));
    stamps.push_back(*stamp);
  }
  return stamps;
}

std::string stemOf(std::filesystem::path path)
{
  if (path.extension() == ".gz") path = path.stem();
  return path.stem().string();
}

/** The integers that the names are; none if another name is among them, or one of less than nine digits. */
std::optional<std::vector<std::int64_t>> integersOf(const Paths& clouds)
{
  constexpr std::size_t kLeastDigits = 9, kMostDigits = 19;
  std::vector<std::int64_t> integers;
  for (const auto& cloud : clouds)
  {
    const std::string name = stemOf(cloud);
    const bool is_integer = name.find_first_not_of("0123456789") == name.npos;
    if (!is_integer || name.size() < kLeastDigits || name.size() > kMostDigits || name > "9223372036854775807")
      return std::nullopt;
    integers.push_back(std::stoll(name));
  }
  return integers;
}

/** As integers, in a unit that their steps tell; none if they only count. */
std::optional<CloudTimes> timesOfIntegers(const Paths& clouds)
{
  const std::optional<std::vector<std::int64_t>> integers = integersOf(clouds);
  if (!integers) return std::nullopt;
  std::vector<double> steps;
  for (std::size_t i = 1; i < integers->size(); ++i)
    steps.push_back(static_cast<double>((*integers)[i] - (*integers)[i - 1]));
  if (!steps.empty() && std::all_of(steps.begin(), steps.end(), [](double step) { return step == 1; }))
    return std::nullopt;
  // The pace of a lidar, which makes a turn in 5 ms to 2 s; the one cloud that there is has a date.
  const std::optional<StampUnit> unit =
      steps.empty() ? unitByDate(integers->front()) : unitByPace(median(steps), 5ms, 2s);
  if (!unit)
    throw std::runtime_error(fmt::format(
        "{} and the other clouds: their names are no times, {} apart: 5 ms to 2 s are expected, in s, ms, us "
        "or ns; give a times.txt with a line for each, in s",
        clouds.front().string(), steps.empty() ? 0 : median(steps)));
  CloudTimes times{{}, fmt::format("the clouds' names, in {}", unit->name)};
  for (const std::int64_t integer : *integers)
  {
    const std::optional<Timestamp> stamp = unit->stampOf(integer);
    if (!stamp) return std::nullopt;
    times.stamps.push_back(*stamp);
  }
  return times;
}

/** As seconds with decimals: 1700000000.100000. */
std::optional<CloudTimes> timesOfDecimals(const Paths& clouds)
{
  CloudTimes times{{}, "the clouds' names, in s"};
  for (const auto& cloud : clouds)
  {
    const std::string name = stemOf(cloud);
    const std::optional<Timestamp> stamp = parseSeconds(name);
    if (!stamp || std::min(name.find_first_not_of("0123456789"), name.size()) < 9) return std::nullopt;
    times.stamps.push_back(*stamp);
  }
  return times;
}

/** Of some of the clouds: the file has a line for each number, 000000 is the first. */
std::optional<std::vector<Timestamp>> stampsOfNumbers(const Paths& clouds, const std::vector<Timestamp>& lines)
{
  std::vector<Timestamp> stamps;
  for (const auto& cloud : clouds)
  {
    const std::string name = stemOf(cloud);
    const bool is_number = !name.empty() && name.size() <= 18 && name.find_first_not_of("0123456789") == name.npos;
    if (!is_number || std::stoul(name) >= lines.size()) return std::nullopt;
    stamps.push_back(lines[std::stoul(name)]);
  }
  return stamps;
}

/** The number at the end of each name; none if a name has none, or one that does not follow the one before. */
std::optional<std::vector<std::int64_t>> countOf(const Paths& clouds)
{
  std::vector<std::int64_t> numbers;
  for (const auto& cloud : clouds)
  {
    const std::string name = stemOf(cloud);
    const std::string digits = name.substr(name.find_last_not_of("0123456789") + 1);
    if (digits.empty() || digits.size() > 8) return std::nullopt;
    numbers.push_back(std::stoll(digits));
    if (numbers.size() > 1 && numbers.back() <= *(numbers.end() - 2)) return std::nullopt;
  }
  return numbers;
}

/** Clouds that are missing in the count, 3 after 1, are missing in time. */
CloudTimes timesOfCount(const Paths& clouds)
{
  CloudTimes times{{}, "none, taken for 10 Hz"};
  const std::optional<std::vector<std::int64_t>> numbers = countOf(clouds);
  for (std::size_t i = 0; i < clouds.size(); ++i)
  {
    const std::int64_t place = numbers ? (*numbers)[i] - numbers->front() : static_cast<std::int64_t>(i);
    times.stamps.push_back(Timestamp{(place + 1) * kDefaultInterval});
  }
  const std::int64_t missing =
      numbers ? numbers->back() - numbers->front() + 1 - static_cast<std::int64_t>(clouds.size()) : 0;
  if (missing > 0) times.source += fmt::format(" by the numbers in their names, of which {} are missing", missing);
  return times;
}

CloudTimes timesAnywhere(const Paths& clouds)
{
  const std::filesystem::path folder = std::filesystem::absolute(clouds.front()).parent_path();
  for (const auto& file : {folder / "times.txt", folder / "timestamps.txt", folder.parent_path() / "times.txt",
                           folder.parent_path() / "timestamps.txt"})
    if (auto stamps = stampsOfFile(file))
    {
      if (stamps->size() == clouds.size()) return {std::move(*stamps), file.string()};
      if (auto of_numbers = stampsOfNumbers(clouds, *stamps)) return {std::move(*of_numbers), file.string()};
      throw std::runtime_error(
          fmt::format("{} has {} times for {} clouds", file.string(), stamps->size(), clouds.size()));
    }
  if (auto times = timesOfIntegers(clouds)) return *times;
  if (auto times = timesOfDecimals(clouds); times && !integersOf(clouds)) return *times;
  return timesOfCount(clouds);
}
}  // namespace

CloudTimes cloudTimes(const Paths& clouds)
{
  CloudTimes times = timesAnywhere(clouds);
  for (std::size_t i = 1; i < times.stamps.size(); ++i)
    if (times.stamps[i] <= times.stamps[i - 1])
      throw std::runtime_error(fmt::format("{} is at {} s by {}, not after {}", clouds[i].string(),
                                           secondsText(times.stamps[i]), times.source, clouds[i - 1].string()));
  return times;
}
}  // namespace scanloom
