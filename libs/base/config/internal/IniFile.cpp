#include "base/config/internal/IniFile.h"

#include "base/config/internal/Expansion.h"
#include "base/core/ConfigError.h"
#include "base/core/Text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
constexpr std::string_view kDefine = "@define";

struct Line
{
  std::string text;
  int number;
};

bool isComment(std::string_view line)
{
  return beginsWith(line, "//") || beginsWith(line, "#") || beginsWith(line, ";");
}
bool isBlank(char c) { return c == ' ' || c == '\t'; }

/** Lines end with LF, CR or both. A `\` before the end continues the line, also in a comment. */
std::vector<Line> logicalLines(std::string_view text)
{
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (beginsWith(text, kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());

  std::vector<Line> lines;
  bool continues = false;
  for (int number = 1; !text.empty(); ++number)
  {
    const auto end = std::min(text.find_first_of("\r\n"), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    text.remove_prefix(beginsWith(text, "\r\n") ? 2 : !text.empty());

    if (!continues) lines.push_back({"", number});
    continues = !line.empty() && line.back() == '\\' && !text.empty();
    if (continues) line.remove_suffix(1);
    lines.back().text += line;
  }
  return lines;
}

/** MRPT looks at the first `//` only, and takes it as a comment only if a blank is before it. */
std::string_view withoutComment(std::string_view value)
{
  const auto slashes = value.find("//");
  if (slashes == std::string_view::npos) return value;
  if (slashes == 0)
    throw std::invalid_argument("MRPT would take the comment for the value: write it on a line of its own");
  if (isBlank(value[slashes - 1])) return trimmed(value.substr(0, slashes));
  if (value.find(" //", slashes) != std::string_view::npos || value.find("\t//", slashes) != std::string_view::npos)
    throw std::invalid_argument(
        "behind a value that holds '//' MRPT takes a comment for a part of it: write it on a line of its own");
  return value;
}

std::string_view withoutAnyComment(std::string_view definition)
{
  definition = trimmed(definition);
  if (withoutComment(definition) == definition) return definition;
  throw std::invalid_argument(
      "MRPT would take the comment for a part of the definition: write it on a line of its own");
}

class IniParser
{
 public:
  explicit IniParser(std::string file) : file_(std::move(file)) {}

  void add(const Line& line)
  {
    const std::string_view text = trimmed(line.text);
    if (text.empty() || isComment(text)) return;
    try
    {
      if (beginsWith(text, kDefine))
        expansion_.define(withoutAnyComment(text.substr(kDefine.size())));
      else if (beginsWith(text, "["))
        section_ = sectionName(text);
      else
        addEntry(text, {file_, line.number});
    }
    catch (const std::invalid_argument& e)
    {
      problems_.push_back(fmt::format("{}:{}: {}", file_, line.number, e.what()));
    }
  }

  std::vector<IniEntry> finish() &&
  {
    if (!problems_.empty()) throw ConfigError(problems_);
    return std::move(entries_);
  }

 private:
  static std::string sectionName(std::string_view text)
  {
    const auto end = text.find(']');
    if (end == std::string_view::npos) throw std::invalid_argument(fmt::format("'{}' lacks its closing ']'", text));
    const std::string_view rest = trimmed(text.substr(end + 1));
    if (!rest.empty() && !isComment(rest))
      throw std::invalid_argument(fmt::format("'{}' behind a section's name", rest));
    return std::string(trimmed(text.substr(1, end - 1)));
  }

  void addEntry(std::string_view text, const Place& place)
  {
    const auto equals = text.find('=');
    const std::string key(trimmed(text.substr(0, equals)));
    if (equals == std::string_view::npos || key.empty())
      throw std::invalid_argument(fmt::format("'{}' must be 'key = value', '[section]' or a comment", text));
    if (!section_) throw std::invalid_argument(fmt::format("{} stands before any [section]", key));

    const std::string_view value = text.substr(equals + 1);
    const bool from_environment = beginsWith(trimmed(value), "$env{");
    entries_.push_back({*section_, key, valueOf(key, value), place,
                        from_environment ? "" : std::filesystem::path(file_).parent_path()});
  }

  std::string valueOf(const std::string& key, std::string_view text) const
  try
  {
    const std::string expanded = expansion_.expand(text);
    return std::string(withoutComment(trimmed(expanded)));
  }
  catch (const std::invalid_argument& e)
  {
    throw std::invalid_argument(fmt::format("[{}] {}: {}", *section_, key, e.what()));
  }

  std::string file_;
  Expansion expansion_;
  std::optional<std::string> section_;
  std::vector<IniEntry> entries_;
  std::vector<std::string> problems_;
};
}  // namespace

std::string toString(const Place& place)
{
  return place.line > 0 ? fmt::format("{}:{}", place.file, place.line) : place.file;
}

std::vector<IniEntry> parseIni(std::string_view text, const std::string& name)
{
  IniParser parser(name);
  for (const Line& line : logicalLines(text)) parser.add(line);
  return std::move(parser).finish();
}
}  // namespace scanloom
