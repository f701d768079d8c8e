/** The parameters of a run: MRPT INI files and what the command line sets on top of them. */
#pragma once
#include "config/ConfigError.h"
#include "config/IniFile.h"
#include "config/Names.h"
#include "config/Schema.h"
#include "config/Values.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace scanloom
{
/** Sections and keys are found without regard to case, as in MRPT. */
class Configuration
{
 public:
  /** @throws ConfigError naming every file that cannot be read, and both places of a key that is given twice. */
  static Configuration fromFiles(const std::vector<std::filesystem::path>&);
  static Configuration fromText(std::string_view text, const std::string& name);

  /** @param assignment `section.key=value` from the command line; replaces a file's value. */
  void set(const std::string& assignment);

  /**
   * The options of a section: the given defaults, overwritten by the keys that are there.
   * @param prefix of each key: `lidar1_` reads `lidar1_pose` into the field `pose`.
   * @throws ConfigError with every value of a wrong type or out of its bounds.
   */
  template <typename Options>
  Options read(const std::string& section, Options options = {}, const std::string& prefix = "") const;

  /**
   * As many as have a name (lidar1_name, lidar2_name, ...), each with the default of its place; without any name, as
   * many as there are defaults.
   */
  template <typename Options>
  std::vector<Options> readList(const std::string& section, std::vector<Options> defaults,
                                const std::string& list) const;

  /** One struct, or a list of them: as `options` has it. */
  template <typename Options>
  void readInto(Options& options, const Section& section) const
  {
    options = read(section.name, options, section.prefix);
  }
  template <typename Options>
  void readInto(std::vector<Options>& options, const Section& section) const
  {
    options = readList(section.name, options, section.prefix);
  }

  bool has(std::string_view section, std::string_view key) const { return find(section, key) != nullptr; }
  std::vector<std::string> sections() const;
  std::vector<std::string> keys(std::string_view section) const;

  /** @throws ConfigError if there is no such key. */
  std::string text(const std::string& section, const std::string& key) const;
  Place place(const std::string& section, const std::string& key) const;

  /** For what only a verb can check: `harvester.ini:12: [ndt] cell_size = 3: must be smaller than ...`. */
  ConfigError complaint(const std::string& section, const std::string& key, const std::string& constraint) const;

  /** A section with a `driver` configures an MRPT sensor: its keys are the sensor's to check. */
  bool isSensor(std::string_view section) const { return has(section, "driver"); }

  /**
   * @param known sections of all verbs; sensors and rawlog-grabber's own [global] are known anyway.
   * @throws ConfigError with place and nearest name of every section and key that `known` does not hold.
   */
  void refuseUnknown(const Schema& known) const;

 private:
  struct Keys
  {
    std::string name;  // as it was first written
    std::map<std::string, IniEntry, CaseInsensitiveLess> entries;
  };

  /** @throws ConfigError for keys of a list's elements from `size` on. */
  void refuseBeyond(const std::string& section, const std::string& list, std::size_t size) const;

  void add(const std::vector<IniEntry>&, std::vector<std::string>& problems);
  const IniEntry* find(std::string_view section, std::string_view key) const;
  const IniEntry& at(const std::string& section, const std::string& key) const;

  std::map<std::string, Keys, CaseInsensitiveLess> sections_;
};

/**
 * What a run uses, as an INI file that repeats it: every value in effect with the place it comes from, then the
 * sensors.
 * @param in_effect schemaOf() the settings that were read.
 */
std::string toIni(const Schema& in_effect, const Configuration&);

/** A section as it was given. */
std::string toIni(const std::string& section, const Configuration&);

/** `harvester.ini:12: [ndt] cell_size = -1 m: must be > 0 (edge of a cell)` */
std::string complaintAbout(const IniEntry&, const Field&, const std::string& constraint);

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
                      problems.push_back(complaintAbout(*entry, field, *constraint));
                  });
  if (!problems.empty()) throw ConfigError(problems);
  return options;
}

template <typename Options>
std::vector<Options> Configuration::readList(const std::string& section, std::vector<Options> defaults,
                                             const std::string& list) const
{
  std::size_t named = 0;
  while (has(section, numbered(list, named) + "name")) ++named;
  std::vector<Options> options = std::move(defaults);
  if (named > 0) options.resize(named);
  refuseBeyond(section, list, options.size());
  for (std::size_t i = 0; i < options.size(); ++i) options[i] = read(section, options[i], numbered(list, i));
  return options;
}

/**
 * All options of a verb, and nothing in the files that no verb knows.
 * @throws ConfigError with all problems of all sections.
 */
template <typename Settings>
Settings readSettings(const Configuration& configuration, const Schema& known)
{
  std::vector<std::string> problems;
  const auto collect = [&](const auto& check)
  {
    try
    {
      check();
    }
    catch (const ConfigError& e)
    {
      problems.insert(problems.end(), e.problems.begin(), e.problems.end());
    }
  };

  Settings settings;
  Settings::sections(settings, [&](auto& options, const Section& section)
                     { collect([&] { configuration.readInto(options, section); }); });
  collect([&] { configuration.refuseUnknown(known); });
  if (!problems.empty()) throw ConfigError(problems);
  return settings;
}
}  // namespace scanloom
