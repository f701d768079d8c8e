#include "base/config/Configuration.h"

#include "base/config/internal/RemovedKeys.h"
#include "base/core/Text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace scanloom
{
namespace
{
constexpr const char* kCommandLine = "--set";

/** The section of rawlog-grabber's own keys, in files that both programs read. */
constexpr std::string_view kGrabberSection = "global";

std::string contentsOf(const std::filesystem::path& file)
{
  if (std::filesystem::is_directory(file)) throw ConfigError(fmt::format("{}: is a folder, not a file", file.string()));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw ConfigError(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string unknown(const std::string& what, const std::string& name, const std::vector<std::string>& candidates)
{
  const std::string hint = suggestion(name, candidates);
  return fmt::format("{}{}{}", what, hint.empty() ? "" : ": ", hint);
}
}  // namespace

void refuse(const std::vector<std::string>& problems)
{
  if (!problems.empty()) throw ConfigError(problems);
}

void collect(std::vector<std::string>& problems, const std::function<void()>& check)
try
{
  check();
}
catch (const ConfigError& e)
{
  problems.insert(problems.end(), e.problems.begin(), e.problems.end());
}

Configuration Configuration::fromFiles(const std::vector<std::filesystem::path>& files)
{
  Configuration configuration;
  std::vector<std::string> problems;
  for (const auto& file : files)
    collect(problems, [&] { configuration.add(parseIni(contentsOf(file), file.string())); });
  refuse(problems);
  return configuration;
}

Configuration Configuration::fromText(std::string_view text, const std::string& name)
{
  Configuration configuration;
  configuration.add(parseIni(text, name));
  return configuration;
}

std::pair<IniEntry&, bool> Configuration::insert(const IniEntry& entry)
{
  Keys& keys = sections_.try_emplace(entry.section, Keys{entry.section, {}}).first->second;
  const auto [place, is_new] = keys.entries.try_emplace(entry.key, entry);
  return {place->second, is_new};
}

void Configuration::add(const std::vector<IniEntry>& entries)
{
  std::vector<std::string> problems;
  for (const IniEntry& entry : entries)
    if (const auto& [first, is_new] = insert(entry); !is_new && first.value != entry.value)
      problems.push_back(fmt::format("{}: [{}] {} = {}: is already set to {} at {}", toString(entry.place),
                                     entry.section, entry.key, entry.value, first.value, toString(first.place)));
  refuse(problems);
}

void Configuration::addDefaults(const Configuration& defaults)
{
  for (const auto& [section, keys] : defaults.sections_)
    for (const auto& [key, entry] : keys.entries) insert(entry);
}

void Configuration::set(const std::string& assignment)
{
  const auto equals = assignment.find('=');
  const std::string name(trimmed(assignment.substr(0, equals)));
  const auto dot = name.rfind('.');  // a section's name may have dots, a key's may not
  if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 == name.size())
    throw ConfigError(fmt::format("{} {}: must be section.key=value", kCommandLine, assignment));

  const IniEntry entry{name.substr(0, dot), name.substr(dot + 1), std::string(trimmed(assignment.substr(equals + 1))),
                       Place{kCommandLine}};
  auto [existing, is_new] = insert(entry);
  if (!is_new && existing.place.file == kCommandLine)
    throw ConfigError(fmt::format("{} {}: is given twice on the command line", kCommandLine, name));
  existing = entry;
}

void Configuration::makePathsAbsolute(const SectionDescription& described)
{
  const auto found = sections_.find(described.section.name);
  if (found == sections_.end()) return;
  for (auto& [key, entry] : found->second.entries)
    if (const Field* field = described.fieldOf(key); field && field->paths && !entry.value.empty())
      entry.value = field->paths(entry.value, std::filesystem::current_path() / entry.folder);
}

std::vector<std::string> Configuration::sections() const
{
  std::vector<std::string> names;
  for (const auto& [section, keys] : sections_) names.push_back(keys.name);
  return names;
}

std::vector<std::string> Configuration::keys(std::string_view section) const
{
  std::vector<std::string> names;
  if (const auto found = sections_.find(section); found != sections_.end())
    for (const auto& [key, entry] : found->second.entries) names.push_back(entry.key);
  return names;
}

const IniEntry* Configuration::find(std::string_view section, std::string_view key) const
{
  const auto found = sections_.find(section);
  if (found == sections_.end()) return nullptr;
  const auto entry = found->second.entries.find(key);
  return entry == found->second.entries.end() ? nullptr : &entry->second;
}

const IniEntry& Configuration::at(const std::string& section, const std::string& key) const
{
  if (const IniEntry* entry = find(section, key)) return *entry;
  throw ConfigError(unknown(fmt::format("[{}] {}: is not set", section, key), key, keys(section)));
}

std::string Configuration::text(const std::string& section, const std::string& key) const
{
  return at(section, key).value;
}

Place Configuration::place(const std::string& section, const std::string& key) const { return at(section, key).place; }

ConfigError Configuration::invalidValue(const std::string& section, const std::string& key,
                                        const std::string& constraint) const
{
  const IniEntry* entry = find(section, key);
  if (!entry) return ConfigError(fmt::format("[{}] {} is not set: {}", section, key, constraint));
  return ConfigError(invalidValueText(*entry, Field{key, "", ""}, constraint));
}

std::string Configuration::misordered(const std::string& section, const std::string& low_key, double low,
                                      const std::string& high_key, double high) const
{
  const std::string is = find(section, low_key)    ? toString(place(section, low_key))
                         : find(section, high_key) ? toString(place(section, high_key))
                                                   : "default";
  return fmt::format("{}: [{}] {} = {}: must be <= {} = {}", is, section, low_key, low, high_key, high);
}

std::vector<std::string> Configuration::unknownKeys(const std::string& section, const SectionDescription& known) const
{
  std::vector<std::string> problems;
  const std::string earlier_section = isSensor(section) ? "lidars" : section;  // a sensor's section has any name
  for (const std::string& key : keys(section))
  {
    const std::vector<std::string> names = known.keysLike(key);
    if (std::any_of(names.begin(), names.end(), [&](const std::string& name) { return sameName(name, key); })) continue;
    const std::string where = fmt::format("{}: [{}] {}", toString(place(section, key)), section, key);
    const std::string earlier_key = elementOf(known.list, key) ? key.substr(key.find('_', known.list.size()) + 1) : key;
    const std::string_view removed = adviceOnRemoved(earlier_section, earlier_key);
    problems.push_back(removed.empty() ? unknown(where + " is an unknown key", key, names)
                                       : fmt::format("{} {}", where, removed));
  }
  return problems;
}

void Configuration::refuseUnknown(const Schema& known) const
{
  std::vector<std::string> problems;
  for (const auto& [name, keys] : sections_)
  {
    if (isSensor(name) || sameName(name, kGrabberSection)) continue;
    const auto described =
        std::find_if(known.begin(), known.end(),
                     [&section = keys.name](const auto& each) { return sameName(each.section.name, section); });
    if (described != known.end())
    {
      const auto of_section = unknownKeys(keys.name, *described);
      problems.insert(problems.end(), of_section.begin(), of_section.end());
      continue;
    }
    std::vector<std::string> names;
    for (const SectionDescription& each : known) names.push_back(each.section.name);
    const std::string where = fmt::format("{}: [{}]", toString(keys.entries.begin()->second.place), keys.name);
    const std::string_view removed = adviceOnRemoved(keys.name);
    problems.push_back(removed.empty() ? unknown(where + " is an unknown section", keys.name, names)
                                       : fmt::format("{} {}", where, removed));
  }
  refuse(problems);
}

void Configuration::refuseBeyond(std::size_t size, const std::string& section, const std::string& list,
                                 const std::string& needs) const
{
  std::vector<std::string> problems;
  for (const std::string& key : keys(section))
    if (const auto element = elementOf(list, key); element && *element > size)
      problems.push_back(fmt::format("{}: [{}] {}: number {} is missing: number them without a gap, and give each {}",
                                     toString(place(section, key)), section, key, size + 1, needs));
  refuse(problems);
}

std::string toIni(const Schema& in_effect, const Configuration& configuration)
{
  std::string text;
  for (const auto& [section, fields, list] : in_effect)
  {
    text += fmt::format("[{}]\n", section.name);
    for (const FieldDescription& described : fields)
    {
      const std::string& key = described.field.name;
      const bool given = configuration.has(section.name, key);
      const std::string origin = given ? toString(configuration.place(section.name, key)) : "default";
      text += fmt::format("# {}\n{} = {}\n", origin, key, described.value);
    }
  }
  for (const std::string& section : configuration.sections())
    if (configuration.isSensor(section)) text += toIni(section, configuration);
  return text;
}

std::string toIni(const std::string& section, const Configuration& configuration)
{
  std::string text = fmt::format("[{}]\n", section);
  for (const std::string& key : configuration.keys(section))
    text += fmt::format("# {}\n{} = {}\n", toString(configuration.place(section, key)), key,
                        configuration.text(section, key));
  return text;
}

std::string invalidValueText(const IniEntry& entry, const Field& field, const std::string& constraint)
{
  return fmt::format("{}: [{}] {} = {}{}{}: {}{}", toString(entry.place), entry.section, entry.key,
                     entry.value.empty() ? "(nothing)" : entry.value, field.unit.empty() ? "" : " ", field.unit,
                     constraint, field.meaning.empty() ? "" : fmt::format(" ({})", field.meaning));
}
}  // namespace scanloom
