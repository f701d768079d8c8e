/** What can be configured, as data: made once from the options structs, it serves checking, default files and manual.
 */
#pragma once
#include "config/Values.h"
#include "core/Field.h"

#include <string>
#include <vector>

namespace scanloom
{
/**
 * The description of one options struct of a verb. The settings of a verb name each once:
 *
 *   struct SlamSettings
 *   {
 *     LocalMapOptions local_map;
 *     std::array<LidarOptions, 2> lidars;
 *
 *     template <typename Self, typename Visitor>
 *     static void sections(Self& s, Visitor&& visit)
 *     {
 *       visit(s.local_map, Section{"local_map", "the keyframes that a scan is aligned to"});
 *       visit(s.lidars[0], Section{"lidars", "where the lidars sit", "lidar1_"});
 *       visit(s.lidars[1], Section{"lidars", "where the lidars sit", "lidar2_"});
 *     }
 *   };
 *
 * A std::vector of options structs that have a 'name' is a list of any length: with the prefix "lidar" its keys are
 * lidar1_name, lidar1_pose, ..., lidar2_name, ...
 */
struct Section
{
  std::string name;
  std::string meaning;      // one phrase
  std::string prefix = "";  // of each of its keys
};

struct FieldDescription
{
  Field field;  // the name with its prefix
  std::string type;
  std::string value;  // the default, or what is in effect
};

struct SectionDescription
{
  Section section;
  std::vector<FieldDescription> fields;
  std::string list = "";  // what its numbered keys begin with; empty: it holds no list

  /** Of `key`, or, where it is a list's, of the list's first element: lidar7_pose is described as lidar1_pose. */
  std::string describedAs(const std::string& key) const;
};
using Schema = std::vector<SectionDescription>;

[[noreturn]] void refuseDefault(const Section&, const Field&, const std::string& constraint);

/** @throws std::logic_error if a value is not within its own bounds: the default file could not be read back. */
template <typename Options>
SectionDescription describe(const Section& section, const Options& options = {})
{
  SectionDescription described{section, {}};
  const auto add = [&](const auto& member, Field field)
  {
    field.name = section.prefix + field.name;
    auto copy = member;
    if (const auto constraint = assign(copy, toText(member), field)) refuseDefault(section, field, *constraint);
    described.fields.push_back({field, typeName(member), toText(member)});
  };
  Options::fields(options, add);
  return described;
}

/** `lidar` and 0 give `lidar1_`. */
std::string numbered(const std::string& list, std::size_t index);

template <typename Options>
SectionDescription describe(const Section& section, const std::vector<Options>& list)
{
  SectionDescription described{section, {}, section.prefix};
  for (std::size_t i = 0; i < list.size(); ++i)
    for (FieldDescription& field :
         describe(Section{section.name, section.meaning, numbered(section.prefix, i)}, list[i]).fields)
      described.fields.push_back(std::move(field));
  return described;
}

/** Two verbs, or two prefixes, may share a section. @throws std::logic_error if they describe a key differently. */
void merge(Schema& into, const SectionDescription&);
void merge(Schema& into, const Schema&);

template <typename Settings>
Schema schemaOf(const Settings& settings = {})
{
  Schema schema;
  Settings::sections(settings,
                     [&](const auto& options, const Section& section) { merge(schema, describe(section, options)); });
  return schema;
}

/** An INI file with every value, each with its meaning, unit and bounds as a comment. */
std::string toIni(const Schema&);

/** The rows of doc/parameters.md: a heading and a table for each section. */
std::string toMarkdown(const Schema&);
}  // namespace scanloom
