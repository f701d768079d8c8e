/** The parameters of a run: MRPT INI files, and the values that --set puts in their place. */
#pragma once
#include "base/config/Names.h"
#include "base/config/Schema.h"
#include "base/config/Values.h"
#include "base/config/internal/IniFile.h"
#include "base/core/ConfigError.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scanloom
{
/** @throws ConfigError with all of them, if there are any. */
void refuse(const std::vector<std::string>& problems);

/** Runs a check, and adds the problems of the ConfigError that it throws. */
void collect(std::vector<std::string>& problems, const std::function<void()>& check);

/** Names of sections and keys are compared without regard to case, as in MRPT. */
class Configuration
{
 public:
  /** @throws ConfigError with every file that cannot be read, and both places of each key that is given two values. */
  static Configuration fromFiles(const std::vector<std::filesystem::path>&);
  static Configuration fromText(std::string_view text, const std::string& name);

  /** Adds each key that is not set. */
  void addDefaults(const Configuration&);

  /** @param assignment `section.key=value` from the command line; replaces the value of a file. */
  void set(const std::string& assignment);

  /**
   * The options of a section: the given defaults, replaced by the keys that are set.
   * @param prefix of each key: with `lidar1_` the field `pose` is read from the key `lidar1_pose`.
   * @throws ConfigError with every value of a wrong type or out of its bounds.
   */
  template <typename Options>
  Options read(const std::string& section, Options options = {}, const std::string& prefix = "") const;

  /**
   * A list of options: those of element N, from 1 on, have the keys `<list>N_...`.
   * @param elements the default of each; there are as many as this has.
   * @param needs key that an element must have to exist, for the message.
   * @throws ConfigError also for a key of an element that does not exist.
   */
  template <typename Options>
  std::vector<Options> readList(const std::string& section, std::vector<Options> elements, const std::string& list,
                                const std::string& needs) const;

  template <typename Options>
  void readInto(Options& options, const Section& section) const
  {
    options = read(section.name, options, section.prefix);
  }

  /** As many as have a name (lidar1_name, lidar2_name, ...); without any name, as many as there are defaults. */
  template <typename Options>
  void readInto(std::vector<Options>& options, const Section& section) const;

  /** Relative paths of the section's keys start where they were written: at the folder of their file. */
  void makePathsAbsolute(const SectionDescription&);

  bool has(std::string_view section, std::string_view key) const { return find(section, key) != nullptr; }
  std::vector<std::string> sections() const;
  std::vector<std::string> keys(std::string_view section) const;

  /** @throws ConfigError if there is no such key. */
  std::string text(const std::string& section, const std::string& key) const;
  Place place(const std::string& section, const std::string& key) const;

  /** To be thrown by a check of a verb: `harvester.ini:12: [ndt] cell_size = 3: must be smaller than ...`. */
  ConfigError invalidValue(const std::string& section, const std::string& key, const std::string& constraint) const;

  /** The section has a `driver`: it configures an MRPT sensor, and the sensor checks its keys. */
  bool isSensor(std::string_view section) const { return has(section, "driver"); }

  /** For each key of the section that is not in `known` its place and the nearest name. */
  std::vector<std::string> unknownKeys(const std::string& section, const SectionDescription& known) const;

  /**
   * @param known sections of all verbs. Sections of sensors and rawlog-grabber's [global] are not checked.
   * @throws ConfigError with place and nearest name of every section and key that is not in `known`.
   */
  void refuseUnknown(const Schema& known) const;

 private:
  struct Keys
  {
    std::string name;  // of the section, as it was first written
    std::map<std::string, IniEntry, CaseInsensitiveLess> entries;
  };

  void refuseBeyond(std::size_t size, const std::string& section, const std::string& list,
                    const std::string& needs) const;

  /** The entry with this name, and whether it is new. */
  std::pair<IniEntry&, bool> insert(const IniEntry&);
  void add(const std::vector<IniEntry>&);
  const IniEntry* find(std::string_view section, std::string_view key) const;
  const IniEntry& at(const std::string& section, const std::string& key) const;

  /** `harvester.ini:12: [crop] min_x = 20: must be <= max_x = 10`; the place is that of the key that is set. */
  std::string misordered(const std::string& section, const std::string& low_key, double low,
                         const std::string& high_key, double high) const;

  std::map<std::string, Keys, CaseInsensitiveLess> sections_;
};

/**
 * An INI file that repeats a run: every value in effect with the place that it comes from, then the sections of
 * sensors.
 * @param in_effect schemaOf() the settings that were read.
 */
std::string toIni(const Schema& in_effect, const Configuration&);

/** A section as it was given, each key with its place. */
std::string toIni(const std::string& section, const Configuration&);

/** `harvester.ini:12: [ndt] cell_size = -1 m: must be > 0 (edge of a cell)` */
std::string invalidValueText(const IniEntry&, const Field&, const std::string& constraint);

template <typename Options>
Options Configuration::read(const std::string& section, Options options, const std::string& prefix) const
{
  std::vector<std::string> problems;
  Options::fields(options,
                  [&](auto& member, const Field& field)
                  {
                    const IniEntry* entry = find(section, prefix + field.name);
                    if (!entry) return;
                    if (const auto constraint = assign(member, entry->value, field))
                      problems.push_back(invalidValueText(*entry, field, *constraint));
                  });
  if constexpr (HasOrder<Options>::value)
    Options::order(options,
                   [&](const char* low_key, double low, const char* high_key, double high)
                   {
                     if (low > high)
                       problems.push_back(misordered(section, prefix + low_key, low, prefix + high_key, high));
                   });
  refuse(problems);
  return options;
}

template <typename Options>
std::vector<Options> Configuration::readList(const std::string& section, std::vector<Options> elements,
                                             const std::string& list, const std::string& needs) const
{
  refuseBeyond(elements.size(), section, list, needs);
  for (std::size_t i = 0; i < elements.size(); ++i) elements[i] = read(section, elements[i], numbered(list, i));
  return elements;
}

template <typename Options>
void Configuration::readInto(std::vector<Options>& options, const Section& section) const
{
  std::size_t named = 0;
  while (has(section.name, numbered(section.prefix, named) + "name")) ++named;
  if (named > 0) options.resize(named);
  options = readList(section.name, options, section.prefix, section.prefix + "N_name");
}

/** All options of a verb. @throws ConfigError with the problems of all sections. */
template <typename Settings>
Settings readSettings(const Configuration& configuration)
{
  std::vector<std::string> problems;
  Settings settings;
  Settings::sections(settings, [&](auto& options, const Section& section)
                     { collect(problems, [&] { configuration.readInto(options, section); }); });
  refuse(problems);
  return settings;
}

/** The same, and @throws ConfigError also for every name that is not in `known`. */
template <typename Settings>
Settings readSettings(const Configuration& configuration, const Schema& known)
{
  std::vector<std::string> problems;
  Settings settings;
  collect(problems, [&] { settings = readSettings<Settings>(configuration); });
  collect(problems, [&] { configuration.refuseUnknown(known); });
  refuse(problems);
  return settings;
}
}  // namespace scanloom
