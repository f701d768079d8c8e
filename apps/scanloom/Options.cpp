#include "Options.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace scanloom
{
Option Option::required() const { return Option(option_->required()); }
Option Option::repeatable() const { return Option(option_->allow_extra_args(false)); }
Option Option::commaSeparated() const { return Option(option_->delimiter(',')); }
Option Option::typeName(const std::string& name) const { return Option(option_->type_name(name)); }
Option Option::group(const std::string& name) const { return Option(option_->group(name)); }
Option Option::showDefault() const { return Option(option_->capture_default_str()); }
Option Option::needs(const Option& other) const { return Option(option_->needs(other.option_)); }
Option Option::excludes(const Option& other) const { return Option(option_->excludes(other.option_)); }
Option Option::existingFile() const { return Option(option_->check(CLI::ExistingFile)); }
Option Option::existingFolder() const { return Option(option_->check(CLI::ExistingDirectory)); }
Option Option::positive() const { return Option(option_->check(CLI::PositiveNumber)); }
Option Option::notNegative() const { return Option(option_->check(CLI::NonNegativeNumber)); }
Option Option::between(int lowest, int highest) const { return Option(option_->check(CLI::Range(lowest, highest))); }
Option Option::between(double lowest, double highest) const
{
  return Option(option_->check(CLI::Range(lowest, highest)));
}
Option Option::oneOf(const std::vector<std::string>& names) const
{
  return Option(option_->check(CLI::IsMember(names)));
}

template <typename Value>
Option addOption(CLI::App& app, const std::string& name, Value& value, const std::string& help)
{
  return Option(app.add_option(name, value, help));
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
