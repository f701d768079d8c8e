/** MRPT's INI dialect, with the file and line of every value. */
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace scanloom
{
/** Where a value was written, for messages: `harvester.ini:12`, or `--set` (line 0). */
struct Place
{
  std::string file;
  int line = 0;
};
std::string toString(const Place&);

struct IniEntry
{
  std::string section;
  std::string key;
  std::string value;  // expanded, trimmed, without its comment
  Place place;        // of the first line, if `\` continues it

  /** Where a relative path in the value starts: at the file's folder, but at the current one (empty) behind $env{}. */
  std::filesystem::path folder = {};
};

/**
 * The entries of one file, in its order: `[section]`, `key = value`, `@define NAME value`, `${NAME}`, `$env{VARIABLE}`,
 * `$eval{formula}`; `\` at the end of a line joins the next one. A line that begins with `#`, `;` or `//` is a comment,
 * and so is the rest of a value from its first ` //` on. Values equal those of mrpt::config::CConfigFile. What MRPT
 * skips or misreads without a message is an error here: a line without `=`, a comment that becomes the value, a key
 * before any section.
 *
 * @param name of the file as the user wrote it; every message begins with it.
 * @throws ConfigError with all problems of the file.
 */
std::vector<IniEntry> parseIni(std::string_view text, const std::string& name);
}  // namespace scanloom
