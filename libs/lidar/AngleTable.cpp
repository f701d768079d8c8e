#include "lidar/AngleTable.h"

#include <fmt/format.h>

#include <cmath>
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
  int channel = 0;
  double vertical = 0, azimuth = 0;
};

std::optional<Row> rowOf(const std::string& line)
{
  std::istringstream in(line);
  in.imbue(std::locale::classic());
  Row row;
  char comma = 0, next_comma = 0;
  if (!(in >> row.channel >> comma >> row.vertical >> next_comma >> row.azimuth)) return std::nullopt;
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
  int number = 0;
  for (std::string line; std::getline(lines, line);)
  {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::optional<Row> row = rowOf(line);
    if (!row && number == 1) continue;
    if (!row) fail(number, "expected 'channel, vertical angle, azimuth' in degrees");
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
}  // namespace scanloom
