#include "base/positions/internal/StationColumns.h"

#include "base/config/Names.h"
#include "base/core/Text.h"
#include "base/formats/SecondsText.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <regex>
#include <stdexcept>

namespace scanloom
{
namespace
{
struct Column
{
  std::string name, unit;
};

/** `X [mm]`, `x(mm)`, `x_mm` and `x mm` are all x in mm. */
Column columnOf(const std::string& title)
{
  static const std::regex pattern(R"(^\W*([a-z]+)[\s_]*[\[(]?\s*([a-z]*)\s*[\])]?\W*$)");
  std::smatch parts;
  const std::string text = lowerCase(title);
  if (!std::regex_match(text, parts, pattern)) return {text, ""};
  return {parts[1], parts[2]};
}

bool isOneOf(const std::string& name, const std::vector<std::string>& names)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

constexpr int kStamp = 3, kLatitude = 4, kLongitude = 5, kSigma = 6, kName = 7;  // 0 to 2: x, y, z

/** The quantity that a column of this name holds, if it is one that we need. */
std::optional<int> quantityOf(const std::string& name)
{
  static const std::vector<std::vector<std::string>> kNames{{"x", "e", "east", "easting"},
                                                            {"y", "n", "north", "northing"},
                                                            {"z", "h", "height", "elevation", "up", "alt", "altitude"},
                                                            {"t", "time", "stamp", "timestamp"},
                                                            {"lat", "latitude"},
                                                            {"lon", "long", "lng", "longitude"},
                                                            {"sigma", "std", "accuracy"},
                                                            {"name", "point", "id"}};
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (isOneOf(name, kNames[i])) return static_cast<int>(i);
  return std::nullopt;
}

template <typename Unit>
Unit unitOf(const Column& column, const std::map<std::string, Unit>& units, Unit without)
{
  if (column.unit.empty()) return without;
  const auto found = units.find(column.unit);
  if (found != units.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [name, unit] : units) known.push_back(name);
  throw std::invalid_argument(
      fmt::format("column '{}': '{}' is no unit: {}", column.name, column.unit, suggestion(column.unit, known)));
}

const std::map<std::string, Duration> kTimes{{"s", 1s}, {"sec", 1s}, {"ms", 1ms}, {"us", 1us}, {"ns", 1ns}};
const std::map<std::string, double> kAngles{{"deg", 1}, {"degrees", 1}};
const std::map<std::string, double> kLengths{{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"ft", 0.3048}};

/** The decimal point some digits to the right: text, so that no digit of a stamp is lost. */
std::string shifted(const std::string& number, std::size_t digits)
{
  const std::size_t sign = number.rfind('-', 0) == 0 ? 1 : 0;
  std::string whole = number.substr(sign, number.find('.') - sign);
  const std::string decimals = number.find('.') == std::string::npos ? "" : number.substr(number.find('.') + 1);
  if (whole.size() <= digits) whole.insert(0, digits + 1 - whole.size(), '0');
  return fmt::format("{}{}.{}{}", sign ? "-" : "", whole.substr(0, whole.size() - digits),
                     whole.substr(whole.size() - digits), decimals);
}

std::size_t digitsOf(Duration unit)
{
  std::size_t digits = 0;
  for (Duration larger = unit; larger < 1s; larger *= 10) ++digits;
  return digits;
}

std::optional<Timestamp> dateOf(const std::string& text)
{
  static const std::regex pattern(
      R"(^(\d{4})-(\d\d)-(\d\d)[T ](\d\d):(\d\d):(\d\d)(?:[.,](\d{1,9}))?\s*(Z|[+-]\d\d:?\d\d)?$)");
  std::smatch parts;
  if (!std::regex_match(text, parts, pattern)) return std::nullopt;
  const auto number = [&](std::size_t i) { return std::stoi(parts[i]); };
  std::tm date{};
  date.tm_year = number(1) - 1900;
  date.tm_mon = number(2) - 1;
  date.tm_mday = number(3);
  date.tm_hour = number(4);
  date.tm_min = number(5);
  date.tm_sec = number(6);
  const std::tm written = date;
  const std::time_t utc = timegm(&date);  // a 31st of June would have become the 1st of July
  if (date.tm_mon != written.tm_mon || date.tm_mday != written.tm_mday || date.tm_sec != written.tm_sec)
    return std::nullopt;
  std::string decimals = parts[7];
  decimals.resize(9, '0');
  std::string zone = parts[8];
  zone.erase(std::remove(zone.begin(), zone.end(), ':'), zone.end());
  const int offset = zone.size() < 5 ? 0 : std::stoi(zone.substr(1, 2)) * 3600 + std::stoi(zone.substr(3, 2)) * 60;
  return parseSeconds(fmt::format("{}.{}", utc - (zone[0] == '-' ? -offset : offset), decimals));
}
}  // namespace

StationColumns StationColumns::ofHeader(const std::vector<std::string>& names)
{
  StationColumns columns;
  std::array<bool, 8> has{};
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const Column column = columnOf(names[i]);
    const auto quantity = quantityOf(column.name);
    if (!quantity) continue;
    const auto q = static_cast<std::size_t>(*quantity);
    if (has[q]) throw std::invalid_argument(fmt::format("column '{}': another one holds the same", names[i]));
    has[q] = true;
    if (*quantity == kStamp)
    {
      columns.stamp = i;
      columns.stamp_unit = unitOf(column, kTimes, Duration(1s));
      continue;
    }
    if (*quantity == kName)
    {
      columns.name = i;
      continue;
    }
    if (*quantity == kSigma)
    {
      columns.sigma = i;
      columns.sigma_unit = unitOf(column, kLengths, 1.0);
      continue;
    }
    const bool is_angle = *quantity == kLatitude || *quantity == kLongitude;
    const std::size_t axis = is_angle ? q - kLatitude : q;
    columns.geodetic |= is_angle;
    columns.position[axis] = i;
    columns.position_unit[axis] = unitOf(column, is_angle ? kAngles : kLengths, 1.0);
  }
  if (columns.geodetic && (has[0] || has[1]))
    throw std::invalid_argument("the header names both latitude or longitude, and x or y: which is it?");
  const std::vector<std::pair<int, const char*>> needed =
      columns.geodetic
          ? std::vector<std::pair<int, const char*>>{{3, "t"}, {4, "lat"}, {5, "lon"}, {2, "height"}}
          : std::vector<std::pair<int, const char*>>{{3, "t"}, {0, "x (or e)"}, {1, "y (or n)"}, {2, "z (or h)"}};
  for (const auto& [q, name] : needed)
    if (!has[static_cast<std::size_t>(q)])
      throw std::invalid_argument(fmt::format("the header names no column {}", name));
  return columns;
}

std::optional<Timestamp> stationTime(const std::string& text, Duration unit)
{
  if (auto date = dateOf(text)) return date;
  return parseSeconds(unit == 1s || text.find_first_of("eE") != std::string::npos ? text
                                                                                  : shifted(text, digitsOf(unit)));
}
}  // namespace scanloom
