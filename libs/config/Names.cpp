#include "config/Names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace scanloom
{
namespace
{
char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

std::string enumerate(const std::vector<std::string>& names)
{
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const char* separator = i == 0 ? "" : i + 1 == names.size() ? " and " : ", ";
    text += fmt::format("{}'{}'", separator, names[i]);
  }
  return text;
}
}  // namespace

std::string_view trimmed(std::string_view text)
{
  constexpr std::string_view kBlanks = " \t\r\n";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

bool CaseInsensitiveLess::operator()(std::string_view a, std::string_view b) const
{
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                      [](char x, char y) { return lower(x) < lower(y); });
}

bool sameName(std::string_view a, std::string_view b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

std::size_t editDistance(std::string_view a, std::string_view b)
{
  std::vector<std::size_t> row(b.size() + 1);  // distances of a's prefix to every prefix of b
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (lower(a[i]) != lower(b[j]));
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates)
{
  if (candidates.empty()) return {};
  const auto nearer = [&](const auto& a, const auto& b) { return editDistance(name, a) < editDistance(name, b); };
  const std::string& nearest = *std::min_element(candidates.begin(), candidates.end(), nearer);
  const std::size_t typing_errors = std::max<std::size_t>(2, name.size() / 3);
  if (editDistance(name, nearest) <= typing_errors) return fmt::format("did you mean '{}'?", nearest);
  return fmt::format("known are {}", enumerate(candidates));
}
}  // namespace scanloom
