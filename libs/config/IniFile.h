/** MRPT's INI dialect, with the file and line of every value. */
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace scanloom
{
/** Where a value was written, for a person: `harvester.ini:12`, or `--set` (line 0). */
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
  Place place;        // of the line's beginning, where `\` continues it
};

/**
 * The entries of one file, in its order: `[section]`, `key = value`, `@define NAME value`, `${NAME}`, `$env{VARIABLE}`,
 * `$eval{formula}`; `\` at the end of a line joins the next one. A line that begins with `#`, `;` or `//` is a comment,
 * and so is what follows the first ` //` of a value. Values equal those of mrpt::config::CConfigFile; what MRPT would
 * skip or misread without a word (a line without `=`, a comment that becomes the value, a key before any
 * section) is an error instead.
 *
 * @param name of the file, as the person wrote it: it leads every message.
 * @throws ConfigError with all problems of the file.
 */
std::vector<IniEntry> parseIni(std::string_view text, const std::string& name);
}  // namespace scanloom
