#include "Options.h"

#include "base/config/Values.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <type_traits>

namespace scanloom
{
Option Option::required() const { return Option(option_->required()); }
Option Option::repeatable() const { return Option(option_->allow_extra_args(false)); }
Option Option::commaSeparated() const { return Option(option_->delimiter(',')); }
Option Option::typeName(const std::string& name) const { return Option(option_->type_name(name)); }
Option Option::group(const std::string& name) const { return Option(option_->group(name)); }
Option Option::optionalValue(const std::string& otherwise) const
{
  return Option(option_->expected(0, 1)->default_str(otherwise));
}
Option Option::showDefault() const { return Option(option_->capture_default_str()); }
Option Option::excludes(const Option& other) const { return Option(option_->excludes(other.option_)); }
Option Option::existingFile() const { return Option(option_->check(CLI::ExistingFile)); }
Option Option::existingFolder() const { return Option(option_->check(CLI::ExistingDirectory)); }
Option Option::positive() const { return within(above(0)); }
Option Option::notNegative() const { return within(atLeast(0)); }
Option Option::between(double lowest, double highest) const { return within(scanloom::between(lowest, highest)); }
Option Option::within(const Bounds& bounds) const
{
  Field field;
  field.bounds = bounds;
  const auto complain = [field](const std::string& text)
  {
    double number = 0;
    const auto constraint = assign(number, text, field);
    return constraint ? fmt::format("'{}' {}", text, *constraint) : std::string();
  };
  return Option(option_->check(complain, toString(bounds)));
}
Option Option::oneOf(const std::vector<std::string>& names) const
{
  return Option(option_->check(CLI::IsMember(names)));
}

namespace
{
template <typename Value>
struct NumberIn
{
  using Type = Value;
};
template <typename Value>
struct NumberIn<std::optional<Value>>
{
  using Type = Value;
};

/** CLI11 takes nan for a number, and -1 for the largest whole number without a sign. Empty if the text is a number. */
template <typename Number>
std::string invalidNumberText(const std::string& text)
{
  Number number{};
  const bool parsed = CLI::detail::lexical_cast(text, number);
  if (std::is_floating_point_v<Number> && !(parsed && std::isfinite(number)))
    return fmt::format("'{}' must be a number", text);
  const bool sign_lost = std::is_unsigned_v<Number> && text.find('-') != std::string::npos;
  if (!parsed || sign_lost)
    return fmt::format("'{}' must be a whole number{}", text, std::is_unsigned_v<Number> ? " >= 0" : "");
  return "";
}
}  // namespace

template <typename Value>
Option addOption(CLI::App& app, const std::string& name, Value& value, const std::string& help)
{
  CLI::Option* option = app.add_option(name, value, help);
  using Number = typename NumberIn<Value>::Type;
  if constexpr (std::is_arithmetic_v<Number>) option->check(&invalidNumberText<Number>);
  return Option(option);
}
template Option addOption(CLI::App&, const std::string&, std::string&, const std::string&);
template Option addOption(CLI::App&, const std::string&, std::filesystem::path&, const std::string&);
template Option addOption(CLI::App&, const std::string&, int&, const std::string&);
template Option addOption(CLI::App&, const std::string&, double&, const std::string&);
template Option addOption(CLI::App&, const std::string&, std::uint64_t&, const std::string&);
template Option addOption(CLI::App&, const std::string&, std::optional<double>&, const std::string&);
template Option addOption(CLI::App&, const std::string&, std::optional<std::uint64_t>&, const std::string&);
template Option addOption(CLI::App&, const std::string&, std::vector<std::string>&, const std::string&);
template Option addOption(CLI::App&, const std::string&, std::vector<std::filesystem::path>&, const std::string&);

Option addFlag(CLI::App& app, const std::string& name, bool& value, const std::string& help)
{
  return Option(app.add_flag(name, value, help));
}

void requireOneOption(CLI::App& app) { app.require_option(1); }

Option addChoice(CLI::App& app, const std::string& name, const std::vector<std::string>& names,
                 std::function<void(std::size_t)> choose, const std::string& help)
{
  const auto chosen = [names, choose = std::move(choose)](const std::string& text)
  { choose(static_cast<std::size_t>(std::find(names.begin(), names.end(), text) - names.begin())); };
  return Option(app.add_option_function<std::string>(name, chosen, help)->check(CLI::IsMember(names).description("")));
}
}  // namespace scanloom
