#include "lidar/BuiltInModels.h"

#include "lidar/MetadataKeys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace scanloom
{
namespace
{
const std::string kDual = " dual";

bool endsWith(std::string_view text, std::string_view end)
{
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

std::string inLowerCase(std::string_view text)
{
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}
}  // namespace

std::string namesOfBuiltInModels()
{
  std::string names;
  for (const BuiltInModel& model : builtInModels()) names += fmt::format("{}{}", names.empty() ? "" : ", ", model.name);
  return names;
}

std::optional<std::string> builtInMetadata(const std::string& name)
{
  std::string wanted = inLowerCase(name);
  const bool dual = endsWith(wanted, kDual);
  if (dual) wanted.resize(wanted.size() - kDual.size());
  for (const BuiltInModel& model : builtInModels())
  {
    if (inLowerCase(model.name) != wanted) continue;
    if (!dual) return std::string(model.metadata);
    nlohmann::json metadata = nlohmann::json::parse(model.metadata);
    metadata["returns"] = 2;
    return metadata.dump();
  }
  return std::nullopt;
}

std::string metadataText(const std::string& file_or_model)
{
  const bool is_path = file_or_model.find('/') != std::string::npos || endsWith(file_or_model, ".json");
  if (is_path || std::filesystem::exists(file_or_model)) return readMetadataText(file_or_model);
  if (const auto text = builtInMetadata(file_or_model)) return *text;
  throw std::invalid_argument(
      fmt::format("{}: there is no such metadata file, and no such model; known are {}, with \" dual\" behind them for "
                  "two returns",
                  file_or_model, namesOfBuiltInModels()));
}
}  // namespace scanloom
