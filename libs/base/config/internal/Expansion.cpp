#include "base/config/internal/Expansion.h"

#include "base/config/MrptMessage.h"
#include "base/config/Names.h"
#include "base/config/Values.h"
#include "base/core/Text.h"

#include <fmt/format.h>
#include <mrpt/expr/CRuntimeCompiledExpression.h>

#include <array>
#include <cstdlib>
#include <regex>
#include <stdexcept>
#include <vector>

namespace scanloom
{
namespace
{
constexpr std::array<std::string_view, 3> kOpenings{"${", "$env{", "$eval{"};

std::string_view openingAt(std::string_view text)
{
  for (const auto opening : kOpenings)
    if (text.substr(0, opening.size()) == opening) return opening;
  return {};
}

std::string environment(const std::string& name)
{
  const char* value = std::getenv(name.c_str());
  if (!value) throw std::invalid_argument(fmt::format("the environment variable {} is not set", name));
  return value;
}

/** The word of the formula that begins a loop, of which the language knows three; empty if there is none. */
std::string loopIn(const std::string& formula)
{
  std::smatch found;
  const bool has_one = std::regex_search(formula, found, std::regex("\\b(for|while|repeat)\\b", std::regex::icase));
  return has_one ? found.str() : "";
}

/** The message of the parser, which MRPT's exception has between back quotes. */
std::string parserMessage(const std::string& what)
{
  constexpr std::string_view kBefore = "Error: `";
  const auto begin = what.find(kBefore);
  if (begin == std::string::npos) return messageIn(what);
  const auto first = begin + kBefore.size();
  return what.substr(first, what.find('`', first) - first);
}
}  // namespace

void Expansion::define(std::string_view rest)
{
  rest = trimmed(rest);
  const std::string name(rest.substr(0, rest.find_first_of(" \t")));
  const std::string value(trimmed(rest.substr(name.size())));
  if (name.empty() || value.empty()) throw std::invalid_argument("must be '@define NAME value'");
  if (texts_.count(name)) throw std::invalid_argument(fmt::format("@define {}: is already defined", name));
  if (value.find("${") != std::string::npos)
    throw std::invalid_argument(
        fmt::format("@define {}: MRPT does not expand ${{}} within a definition: "
                    "write $eval{{}} for a number, or the text itself",
                    name));

  const std::string text = expand(value);
  if (const auto number = parseNumber(text)) numbers_[name] = *number;
  texts_[name] = text;
}

std::string Expansion::expand(std::string_view text) const
{
  std::string expanded;
  while (!text.empty())
  {
    const std::string_view opening = openingAt(text);
    if (opening.empty())
    {
      expanded += text.front();
      text.remove_prefix(1);
      continue;
    }
    const auto end = text.find('}');
    if (end == std::string_view::npos) throw std::invalid_argument(fmt::format("'{}' lacks its closing '}}'", text));
    expanded += valueOf(opening, std::string(text.substr(opening.size(), end - opening.size())));
    text.remove_prefix(end + 1);
  }
  return expanded;
}

std::string Expansion::valueOf(std::string_view opening, const std::string& inside) const
{
  if (opening == "$env{") return environment(inside);
  if (opening == "$eval{") return fmt::format("{:e}", evaluate(inside));

  if (const auto found = texts_.find(inside); found != texts_.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, value] : texts_) names.push_back(name);
  const std::string hint = suggestion(inside, names);
  throw std::invalid_argument(fmt::format("${{{}}} is not defined{}{}", inside, hint.empty() ? "" : ": ", hint));
}

double Expansion::evaluate(const std::string& formula) const
{
  if (const std::string loop = loopIn(formula); !loop.empty())
    throw std::invalid_argument(fmt::format("$eval{{{}}}: '{}' is not allowed: a formula has no loops", formula, loop));
  mrpt::expr::CRuntimeCompiledExpression expression;
  try
  {
    expression.compile(formula, numbers_);
  }
  catch (const std::exception& e)
  {
    throw std::invalid_argument(fmt::format("$eval{{{}}}: {}", formula, parserMessage(e.what())));
  }
  return expression.eval();
}
}  // namespace scanloom
