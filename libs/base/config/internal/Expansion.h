/** The variables and formulas of MRPT's INI files (mrpt::config::config_parser). */
#pragma once
#include <map>
#include <string>
#include <string_view>

namespace scanloom
{
/**
 * Keeps the `@define` lines so far, and expands `${NAME}`, `$env{VARIABLE}` and `$eval{formula}`.
 *
 * A formula is rounded to six digits behind the point, as MRPT does it, so that a file means the same number, to the
 * bit, here and in MRPT's applications. Where MRPT silently uses nothing or a wrong value (an environment variable that
 * is not set, a text in a formula, `${}` within a definition), this throws std::invalid_argument. Its message has no
 * file and line: the caller adds them.
 */
class Expansion
{
 public:
  /** `rest` is the line behind `@define`: a name, blanks and the value. */
  void define(std::string_view rest);

  std::string expand(std::string_view text) const;

 private:
  std::string valueOf(std::string_view opening, const std::string& inside) const;
  double evaluate(const std::string& formula) const;

  std::map<std::string, std::string> texts_;
  std::map<std::string, double> numbers_;  // the texts_ that are numbers
};
}  // namespace scanloom
