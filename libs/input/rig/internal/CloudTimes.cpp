#include "input/rig/internal/CloudTimes.h"

#include "base/formats/SecondsText.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>

namespace scanloom
{
namespace
{
using Paths = std::vector<std::filesystem::path>;

constexpr Duration kDefaultInterval = 100ms;  // 10 Hz

std::optional<std::vector<Timestamp>> stampsOfFile(const std::filesystem::path& path)
{
  std::ifstream file(path);
  if (!file) return std::nullopt;
  std::vector<Timestamp> stamps;
  for (std::string line; std::getline(file, line);)
  {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line.empty()) continue;
    const std::optional<Timestamp> stamp = parseSeconds(line);
    if (!stamp) throw std::runtime_error(fmt::format("{}: '{}' is no time in s", path.string(), line));
    stamps.push_back(*stamp);
  }
  return stamps;
}

std::string stemOf(std::filesystem::path path)
{
  if (path.extension() == ".gz") path = path.stem();
  return path.stem().string();
}

/** 1700000000.100000 or 1700000000100000000. */
std::optional<Timestamp> stampOfName(const std::string& name)
{
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  if (digits < 9) return std::nullopt;
  if (digits == name.size() && digits >= 16 && digits <= 19) return Timestamp{Duration{std::stoll(name)}};
  return parseSeconds(name);
}

std::optional<std::vector<Timestamp>> stampsOfNames(const Paths& clouds)
{
  std::vector<Timestamp> stamps;
  for (const auto& cloud : clouds)
  {
    const std::optional<Timestamp> stamp = stampOfName(stemOf(cloud));
    if (!stamp) return std::nullopt;
    stamps.push_back(*stamp);
  }
  return stamps;
}

/** Of some of the clouds: the file has a line for each number, 000000 is the first. */
std::optional<std::vector<Timestamp>> stampsOfNumbers(const Paths& clouds, const std::vector<Timestamp>& lines)
{
  std::vector<Timestamp> stamps;
  for (const auto& cloud : clouds)
  {
    const std::string name = stemOf(cloud);
    const bool is_number = !name.empty() && name.size() < 9 && name.find_first_not_of("0123456789") == name.npos;
    if (!is_number || std::stoul(name) >= lines.size()) return std::nullopt;
    stamps.push_back(lines[std::stoul(name)]);
  }
  return stamps;
}

CloudTimes timesAnywhere(const Paths& clouds)
{
  const std::filesystem::path folder = std::filesystem::absolute(clouds.front()).parent_path();
  for (const auto& file : {folder / "times.txt", folder.parent_path() / "times.txt"})
    if (auto stamps = stampsOfFile(file))
    {
      if (stamps->size() == clouds.size()) return {std::move(*stamps), file.string()};
      if (auto of_numbers = stampsOfNumbers(clouds, *stamps)) return {std::move(*of_numbers), file.string()};
      throw std::runtime_error(
          fmt::format("{} has {} times for {} clouds", file.string(), stamps->size(), clouds.size()));
    }
  if (auto stamps = stampsOfNames(clouds)) return {std::move(*stamps), "the clouds' names"};
  CloudTimes times{{}, "none, taken for 10 Hz"};
  for (std::size_t i = 0; i < clouds.size(); ++i)
    times.stamps.push_back(Timestamp{static_cast<std::int64_t>(i + 1) * kDefaultInterval});
  return times;
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
