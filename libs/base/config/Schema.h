/** Descriptions of all options, as data for checking configuration files, writing default files and the manual. */
#pragma once
#include "base/config/Values.h"
#include "base/core/Field.h"

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace scanloom
{
/**
 * The section that one options struct of a verb is read from. The settings of a verb list them:
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
 * A std::vector of options structs with a field 'name' is a list of any length: with the prefix "lidar" its keys are
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
  std::string value;  // the default, or the value in effect
};

struct SectionDescription
{
  Section section;
  std::vector<FieldDescription> fields;
  std::string list = "";  // of its numbered keys: "lidar" for lidar1_pose; empty: it has none

  /** All keys; those of a list once, with the number that `key` has: lidar7_metadata, lidar7_pose, ... for lidar7_poze.
   */
  std::vector<std::string> keysLike(const std::string& key) const;

  /** The field that describes the key, that of lidar1_pose also for lidar7_pose; nullptr: none. */
  const Field* fieldOf(const std::string& key) const;
};
using Schema = std::vector<SectionDescription>;

/**
 * An options struct may say which of its fields must not be above another one:
 *
 *   template <typename Self, typename Visitor>
 *   static void order(const Self& o, Visitor&& visit)
 *   {
 *     visit("min_x", o.min_x, "max_x", o.max_x);
 *   }
 */
template <typename Options, typename = void>
struct HasOrder : std::false_type
{
};
using OrderVisitor = void (*)(const char* low_key, double low, const char* high_key, double high);
template <typename Options>
struct HasOrder<Options, std::void_t<decltype(Options::order(std::declval<const Options&>(), OrderVisitor{}))>>
  : std::true_type
{
};

[[noreturn]] void refuseDefault(const Section&, const Field&, const std::string& constraint);

/** @throws std::logic_error if a default is out of its bounds: the default file could not be read back. */
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

/** The number of the element that has this key: 7 for `lidar` and `lidar7_pose`. */
std::optional<std::size_t> elementOf(const std::string& list, const std::string& key);

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

/** Two options structs may share a section. @throws std::logic_error if they describe the same key differently. */
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

/** "edge of a cell [m], > 0": meaning, unit and what is allowed. */
std::string inWords(const FieldDescription&);

/** An INI file with every value, each with its meaning, unit and bounds as a comment. */
std::string toIni(const Schema&);

/** The rows of doc/parameters.md: a heading and a table for each section, of a list only its first element. */
std::string toMarkdown(const Schema&);
}  // namespace scanloom
