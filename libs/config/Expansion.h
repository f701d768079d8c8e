/** The variables and formulas of MRPT's INI files (mrpt::config::config_parser). */
#pragma once
#include <map>
#include <string>
#include <string_view>

namespace scanloom
{
/**
 * Knows what `@define` lines said so far and expands `${NAME}`, `$env{VARIABLE}` and `$eval{formula}`.
 *
 * A formula gives six digits behind the point, as MRPT writes it, so that a file means the same number to the bit
 * here and in MRPT's own applications. Where MRPT would silently go on with nothing or a wrong value (an environment
 * variable that is not set, a text in a formula, `${}` within a definition), this throws instead. All errors are
 * std::invalid_argument without file and line: the caller knows these.
 */
class Expansion
{
 public:
  /** `rest` is what stands behind `@define` in the line: a name, blanks and the value. */
  void define(std::string_view rest);

  std::string expand(std::string_view text) const;

 private:
  std::string valueOf(std::string_view opening, const std::string& inside) const;
  double evaluate(const std::string& formula) const;

  std::map<std::string, std::string> texts_;
  std::map<std::string, double> numbers_;  // those of texts_ that are numbers
};
}  // namespace scanloom
