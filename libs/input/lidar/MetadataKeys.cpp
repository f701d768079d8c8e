#include "input/lidar/MetadataKeys.h"

#include "base/core/Text.h"
#include "base/core/jsonText.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace scanloom
{
namespace
{
/** A value as an error message shows it: short, whatever stood in the file. */
std::string shown(const nlohmann::json& value)
{
  const std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

bool isNumberWithin(const nlohmann::json& value, double lowest, double highest)
{
  if (!value.is_number()) return false;
  const double x = value.get<double>();
  return std::isfinite(x) && x >= lowest && x <= highest;
}
}  // namespace

std::string readMetadataText(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    throw std::invalid_argument(fmt::format("{}: metadata file can't be read or is empty", path));
  return text.str();
}

MetadataKeys::MetadataKeys(const std::string& text, std::string name) : name_(std::move(name))
{
  try
  {
    root_ = std::make_unique<const nlohmann::json>(nlohmann::json::parse(text));
  }
  catch (const nlohmann::json::exception& e)
  {
    throw std::invalid_argument(
        fmt::format("{}: not a metadata file, its text is no valid JSON ({})", name_, printable(reasonOf(e))));
  }
  if (!root_->is_object())
    throw std::invalid_argument(fmt::format("{}: not a metadata file, expected a JSON object with keys", name_));
}

MetadataKeys::~MetadataKeys() = default;

const nlohmann::json* MetadataKeys::find(const std::string& section, const std::string& key) const
{
  const auto within = root_->find(section);
  for (const nlohmann::json* object : {within == root_->end() ? nullptr : &*within, root_.get()})
  {
    // A section may be a text instead: Ouster's firmware 1.12 and 1.13 write an error there.
    if (!object || !object->is_object()) continue;
    const auto found = object->find(key);
    if (found != object->end() && !found->is_null()) return &*found;
  }
  return nullptr;
}

void MetadataKeys::fail(const std::string& key, const std::string& problem) const
{
  throw std::invalid_argument(fmt::format("{}: {}: {}", name_, key, problem));
}

std::optional<std::string> MetadataKeys::text(const std::string& section, const std::string& key) const
{
  const nlohmann::json* value = find(section, key);
  if (!value) return std::nullopt;
  if (!value->is_string()) fail(key, fmt::format("must be a text in quotes, not {}", shown(*value)));
  return printable(value->get<std::string>());
}

std::optional<double> MetadataKeys::number(const std::string& section, const std::string& key, double lowest,
                                           double highest) const
{
  const nlohmann::json* value = find(section, key);
  if (!value) return std::nullopt;
  if (!isNumberWithin(*value, lowest, highest))
    fail(key, fmt::format("must be a number from {} to {}, not {}", lowest, highest, shown(*value)));
  return value->get<double>();
}

std::optional<int> MetadataKeys::integer(const std::string& section, const std::string& key, int lowest,
                                         int highest) const
{
  const nlohmann::json* value = find(section, key);
  if (!value) return std::nullopt;
  if (!isNumberWithin(*value, lowest, highest) || value->get<double>() != std::floor(value->get<double>()))
    fail(key, fmt::format("must be a whole number from {} to {}, not {}", lowest, highest, shown(*value)));
  return static_cast<int>(value->get<double>());
}

std::optional<std::vector<double>> MetadataKeys::numbers(const std::string& section, const std::string& key,
                                                         double lowest, double highest) const
{
  const nlohmann::json* value = find(section, key);
  if (!value) return std::nullopt;
  if (!value->is_array()) fail(key, fmt::format("must be a list of numbers, not {}", shown(*value)));
  std::vector<double> result;
  for (const nlohmann::json& element : *value)
  {
    if (element.is_array()) fail(key, "is a table, not a list of numbers: solid-state sensors are not supported");
    if (!isNumberWithin(element, lowest, highest))
      fail(key, fmt::format("element {} must be a number from {} to {}, not {}", result.size(), lowest, highest,
                            shown(element)));
    result.push_back(element.get<double>());
  }
  return result;
}

bool namesLidar(const std::string& text, const std::string& maker)
{
  if (text.find(maker) == std::string::npos) return false;  // spares parsing long files of other makers
  try
  {
    return MetadataKeys(text, "").text(kTopLevel, "lidar") == maker;
  }
  catch (const std::invalid_argument&)
  {
    return false;
  }
}
}  // namespace scanloom
