#include "lab/study/internal/AxisValues.h"

#include "base/core/Text.h"
#include "base/core/parseWhole.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>

namespace scanloom
{
namespace
{
template <typename Number>
std::optional<Number> positive(const std::string& text)
{
  const auto value = parseWhole<Number>(text);
  return value && *value >= 1 ? value : std::nullopt;
}
}  // namespace

std::vector<std::string> wordsOf(const std::string& text)
{
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::vector<std::string> valuesOf(const std::string& text)
{
  std::vector<std::string> values;
  std::istringstream stream(text);
  for (std::string value; std::getline(stream, value, '|');) values.emplace_back(trimmed(value));
  return values;
}

std::vector<std::uint64_t> seedsOf(const std::string& text, const Configuration& configuration)
{
  constexpr std::uint64_t kMost = 100000;
  const auto refuse = [&]
  { return configuration.invalidValue("experiment", "seeds", "must be whole numbers from 1 on, or first:last"); };
  std::vector<std::uint64_t> seeds;
  for (const std::string& word : wordsOf(text))
  {
    const std::size_t colon = std::min(word.find(':'), word.size());
    const auto first = positive<std::uint64_t>(word.substr(0, colon));
    const auto last = colon == word.size() ? first : positive<std::uint64_t>(word.substr(colon + 1));
    if (!first || !last || *last < *first || *last - *first > kMost) throw refuse();
    for (std::uint64_t seed = *first; seed <= *last; ++seed) seeds.push_back(seed);
  }
  if (seeds.empty()) throw refuse();
  return seeds;
}

std::vector<int> countsOf(const std::string& text, const Configuration& configuration)
{
  std::vector<int> counts;
  for (const std::string& word : wordsOf(text))
  {
    const auto count = positive<int>(word);
    if (!count) throw configuration.invalidValue("experiment", "every_nth", "must be whole numbers from 1 on");
    counts.push_back(*count);
  }
  if (counts.empty()) throw configuration.invalidValue("experiment", "every_nth", "must have at least one number");
  return counts;
}
}  // namespace scanloom
