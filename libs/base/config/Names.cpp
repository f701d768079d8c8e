#include "base/config/Names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <iterator>
#include <numeric>

namespace scanloom
{
namespace
{
constexpr std::size_t kFew = 10;

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

std::string enumerate(const std::vector<std::string>& names, const char* last = " and ")
{
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const char* separator = i == 0 ? "" : i + 1 == names.size() ? last : ", ";
    text += fmt::format("{}'{}'", separator, names[i]);
  }
  return text;
}

/** "max_range" -> "range_max". */
std::string withSortedWords(std::string_view name)
{
  std::vector<std::string> words(1);
  for (const char c : name)
    if (c == '_')
      words.emplace_back();
    else
      words.back().push_back(lower(c));
  std::sort(words.begin(), words.end(), std::greater<>());
  std::string sorted;
  for (const std::string& word : words) sorted += (sorted.empty() ? "" : "_") + word;
  return sorted;
}

/** Of the words in any order. */
std::size_t distance(std::string_view a, std::string_view b)
{
  return std::min(editDistance(a, b), editDistance(withSortedWords(a), withSortedWords(b)));
}

bool contains(std::string_view name, std::string_view part)
{
  return std::search(name.begin(), name.end(), part.begin(), part.end(),
                     [](char x, char y) { return lower(x) == lower(y); }) != name.end();
}
}  // namespace

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
  const auto nearer = [&](const auto& a, const auto& b) { return distance(name, a) < distance(name, b); };
  const std::string& nearest = *std::min_element(candidates.begin(), candidates.end(), nearer);
  const std::size_t typing_errors = std::max<std::size_t>(2, name.size() / 3);
  if (distance(name, nearest) <= typing_errors) return fmt::format("did you mean '{}'?", nearest);

  std::vector<std::string> longer;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(longer),
               [&](const std::string& candidate) { return name.size() >= 3 && contains(candidate, name); });
  if (!longer.empty() && longer.size() <= kFew) return fmt::format("did you mean {}?", enumerate(longer, " or "));
  if (candidates.size() <= kFew) return fmt::format("known are {}", enumerate(candidates));
  return fmt::format("the nearest of {} known names is '{}'", candidates.size(), nearest);
}
}  // namespace scanloom
