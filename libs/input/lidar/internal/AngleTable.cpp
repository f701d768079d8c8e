#include "input/lidar/internal/AngleTable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace scanloom
{
namespace
{
struct Row
{
  int channel = 0;  // 0: the next one
  double vertical = 0, azimuth = 0;
};

std::optional<Row> rowOf(const std::string& line)
{
  std::istringstream in(line);
  in.imbue(std::locale::classic());
  Row row;
  char comma = 0, next_comma = 0;
  if (std::count(line.begin(), line.end(), ',') == 1)
  {
    next_comma = ',';
    if (!(in >> row.vertical >> comma >> row.azimuth)) return std::nullopt;
  }
  else if (!(in >> row.channel >> comma >> row.vertical >> next_comma >> row.azimuth) || row.channel == 0)
    return std::nullopt;
  in >> std::ws;
  const bool ends = in.eof() || in.peek() == ',';  // some files have further columns
  const bool angles = std::abs(row.vertical) <= 90 && std::abs(row.azimuth) <= 360;
  return comma == ',' && next_comma == ',' && ends && angles ? std::optional(row) : std::nullopt;
}

}  // namespace

AngleTable parseAngleTable(const std::string& text, const std::string& name, int channels)
{
  const auto fail = [&](int line, const std::string& problem)
  { throw std::invalid_argument(fmt::format("{}:{}: {}", name, line, problem)); };
  const auto count = static_cast<std::size_t>(channels);
  AngleTable table{std::vector<double>(count, NAN), std::vector<double>(count, NAN)};
  std::istringstream lines(text);
  int number = 0, rows = 0;
  for (std::string line; std::getline(lines, line);)
  {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::optional<Row> row = rowOf(line);
    if (!row && number == 1) continue;
    ++rows;
    const bool titled = number > rows;  // two columns with titles are something else: channels and firing times
    if (!row || (row->channel == 0 && titled))
      fail(number,
           "expected 'channel, vertical angle, azimuth' or, without titles, 'vertical angle, azimuth' in degrees");
    if (row->channel == 0) row->channel = rows;
    if (row->channel < 1 || row->channel > channels)
      fail(number, fmt::format("channel {} is none of 1 to {}", row->channel, channels));
    const auto place = static_cast<std::size_t>(row->channel - 1);
    if (!std::isnan(table.vertical[place])) fail(number, fmt::format("channel {} has two rows", row->channel));
    table.vertical[place] = row->vertical;
    table.azimuth[place] = row->azimuth;
  }
  for (std::size_t i = 0; i < count; ++i)
    if (std::isnan(table.vertical[i])) fail(number, fmt::format("channel {} of {} has no row", i + 1, channels));
  return table;
}

std::vector<double> numberPerChannel(const MetadataKeys& keys, const std::string& key, int channels, double limit,
                                     const char* instead)
{
  auto list = keys.numbers(kTopLevel, key, -limit, limit);
  if (!list) keys.fail(key, fmt::format("is missing; expected {} numbers{}", channels, instead));
  if (list->size() != static_cast<std::size_t>(channels))
    keys.fail(key, fmt::format("must have {} numbers, one per channel, not {}", channels, list->size()));
  return *std::move(list);
}

AngleTable readAngles(const MetadataKeys& keys, const std::string& name, int channels)
{
  if (const auto file = keys.text(kTopLevel, "angles"))
  {
    const std::string path = (std::filesystem::path(name).parent_path() / *file).string();
    return parseAngleTable(readMetadataText(path), path, channels);
  }
  const char* const instead = ", or \"angles\": \"FILE.csv\"";
  return {numberPerChannel(keys, "vertical_angles_deg", channels, 90, instead),
          numberPerChannel(keys, "azimuth_offsets_deg", channels, 30, instead)};
}
}  // namespace scanloom
