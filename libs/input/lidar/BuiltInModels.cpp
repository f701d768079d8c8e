#include "input/lidar/BuiltInModels.h"

#include "base/core/Text.h"
#include "input/lidar/MetadataKeys.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>

namespace scanloom
{
namespace
{
const std::string kDual = " dual";

/** Cuts " 1200 rpm" off the end of a name in lower case. */
std::optional<int> takeRpm(std::string& name)
{
  static const std::regex kRpm(" +([0-9]{3,4}) ?rpm$");
  std::smatch found;
  if (!std::regex_search(name, found, kRpm)) return std::nullopt;
  const int rpm = std::stoi(found[1]);
  name.resize(static_cast<std::size_t>(found.position()));
  return rpm;
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
  std::string wanted = lowerCase(name);
  const std::optional<int> rpm = takeRpm(wanted);
  const bool dual = endsWith(wanted, kDual);
  if (dual) wanted.resize(wanted.size() - kDual.size());
  for (const BuiltInModel& model : builtInModels())
  {
    if (lowerCase(model.name) != wanted) continue;
    if (!dual && !rpm) return std::string(model.metadata);
    nlohmann::json metadata = nlohmann::json::parse(model.metadata);
    if (dual) metadata["returns"] = 2;
    if (rpm) metadata["rpm"] = *rpm;
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
                  "two returns, then \" 1200 rpm\" for another rotor than that of 600",
                  file_or_model, namesOfBuiltInModels()));
}
}  // namespace scanloom
