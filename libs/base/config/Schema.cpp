#include "base/config/Schema.h"

#include "base/config/Names.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace scanloom
{
namespace
{
bool same(const FieldDescription& a, const FieldDescription& b)
{
  return a.type == b.type && a.value == b.value && a.field.unit == b.field.unit && a.field.meaning == b.field.meaning &&
         toString(a.field.bounds) == toString(b.field.bounds);
}

std::string allowed(const FieldDescription& described)
{
  const std::string bounds = toString(described.field.bounds);
  if (described.type == "bool") return "true or false";
  if (described.type == "int") return "whole number" + (bounds.empty() ? "" : ", " + bounds);
  return bounds;
}

std::string inTableCell(std::string text)
{
  for (auto bar = text.find('|'); bar != std::string::npos; bar = text.find('|', bar + 2)) text.insert(bar, "\\");
  return text;
}
}  // namespace

std::string inWords(const FieldDescription& described)
{
  const Field& field = described.field;
  const std::string bounds = allowed(described);
  return fmt::format("{}{}{}{}", field.meaning, field.unit.empty() ? "" : fmt::format(" [{}]", field.unit),
                     bounds.empty() ? "" : ", ", bounds);
}

void refuseDefault(const Section& section, const Field& field, const std::string& constraint)
{
  throw std::logic_error(fmt::format("[{}] {}: its default {}", section.name, field.name, constraint));
}

std::string numbered(const std::string& list, std::size_t index) { return fmt::format("{}{}_", list, index + 1); }

std::optional<std::size_t> elementOf(const std::string& list, const std::string& key)
{
  if (list.empty() || !sameName(key.substr(0, list.size()), list)) return std::nullopt;
  std::size_t number = 0;
  const char *const begin = key.data() + list.size(), *const end = key.data() + key.size();
  const auto [rest, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || rest == end || *rest != '_' || number == 0) return std::nullopt;
  return number;
}

std::vector<std::string> SectionDescription::keysLike(const std::string& key) const
{
  const std::size_t wanted = elementOf(list, key).value_or(1);
  std::vector<std::string> keys;
  for (const FieldDescription& described : fields)
  {
    const std::string& name = described.field.name;
    const auto element = elementOf(list, name);
    if (!element)
      keys.push_back(name);
    else if (*element == 1)
      keys.push_back(numbered(list, wanted - 1) + name.substr(numbered(list, 0).size()));
  }
  return keys;
}

const Field* SectionDescription::fieldOf(const std::string& key) const
{
  const std::string first = elementOf(list, key) ? numbered(list, 0) + key.substr(key.find('_', list.size()) + 1) : key;
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const auto& described) { return sameName(described.field.name, first); });
  return found == fields.end() ? nullptr : &found->field;
}

void merge(Schema& into, const SectionDescription& added)
{
  const auto existing = std::find_if(
      into.begin(), into.end(), [&](const auto& described) { return described.section.name == added.section.name; });
  if (existing == into.end())
  {
    into.push_back(added);
    return;
  }
  if (existing->list.empty()) existing->list = added.list;
  for (const FieldDescription& field : added.fields)
  {
    const auto twin = std::find_if(existing->fields.begin(), existing->fields.end(),
                                   [&](const auto& other) { return other.field.name == field.field.name; });
    if (twin == existing->fields.end())
      existing->fields.push_back(field);
    else if (!same(*twin, field))
      throw std::logic_error(
          fmt::format("[{}] {} is declared twice, with different descriptions", added.section.name, field.field.name));
  }
}

void merge(Schema& into, const Schema& added)
{
  for (const SectionDescription& described : added) merge(into, described);
}

std::string toIni(const Schema& schema)
{
  std::string text;
  for (const SectionDescription& described : schema)
  {
    text += fmt::format("{}# {}\n[{}]\n", text.empty() ? "" : "\n", described.section.meaning, described.section.name);
    for (const FieldDescription& field : described.fields)
    {
      const std::string line = fmt::format("{} = {}", field.field.name, field.value);
      text += fmt::format("# {}\n{}\n", inWords(field), line.substr(0, line.find_last_not_of(' ') + 1));
    }
  }
  return text;
}

std::string toMarkdown(const Schema& schema)
{
  std::string text;
  for (const SectionDescription& described : schema)
  {
    text += fmt::format("{}## [{}]\n{}\n\n| key | default | meaning |\n|---|---|---|\n", text.empty() ? "" : "\n",
                        described.section.name, described.section.meaning);
    for (const FieldDescription& field : described.fields)
      if (elementOf(described.list, field.field.name).value_or(1) == 1)
        text += fmt::format("| `{}` | {} | {} |\n", field.field.name, inTableCell(field.value),
                            inTableCell(inWords(field)));
  }
  return text;
}
}  // namespace scanloom
