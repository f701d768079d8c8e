/** The options of a verb. Only Options.cpp includes CLI11, which takes 10 s to compile in every file that does. */
#pragma once
#include "base/core/Field.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace CLI
{
class App;
class Option;
}  // namespace CLI

namespace scanloom
{
/** One option. Each function returns the option again. */
class Option
{
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option required() const;
  Option repeatable() const;      // may be given several times, with one value each
  Option commaSeparated() const;  // several values in one argument

  Option typeName(const std::string&) const;                 // shown in the help as the type of the value, e.g. FILE
  Option group(const std::string&) const;                    // shown in the help under this heading
  Option optionalValue(const std::string& otherwise) const;  // may be given without its value
  Option showDefault() const;                                // shown in the help with the value that it has now

  Option excludes(const Option&) const;  // must not be given together with the other option

  /** Checks of the value. */
  Option existingFile() const;
  Option existingFolder() const;
  Option positive() const;
  Option notNegative() const;
  Option between(double lowest, double highest) const;
  Option oneOf(const std::vector<std::string>&) const;

 private:
  Option within(const Bounds&) const;

  CLI::Option* option_;
};

/**
 * @param name "-o,--output", or "FILE" for an argument without a name.
 * Value is std::string, std::filesystem::path, int, double, std::uint64_t, a std::optional of a number, or a
 * std::vector of texts or paths. A number must be one: nan, inf and a sign that the type cannot hold are refused.
 */
template <typename Value>
Option addOption(CLI::App&, const std::string& name, Value&, const std::string& help);

/** An option without a value. */
Option addFlag(CLI::App&, const std::string& name, bool&, const std::string& help);

/** Exactly one of the options must be given. */
void requireOneOption(CLI::App&);

/** The value is one of `names`; `choose` is called with its index. */
Option addChoice(CLI::App&, const std::string& name, const std::vector<std::string>& names,
                 std::function<void(std::size_t)> choose, const std::string& help);

template <typename Value>
Option addChoice(CLI::App& app, const std::string& name, Value& value,
                 const std::vector<std::pair<std::string, Value>>& choices, const std::string& help)
{
  std::vector<std::string> names;
  for (const auto& choice : choices) names.push_back(choice.first);
  return addChoice(
      app, name, names, [&value, choices](std::size_t i) { value = choices[i].second; }, help);
}
}  // namespace scanloom
