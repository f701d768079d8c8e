#include "input/rig/internal/naturalOrder.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>

namespace scanloom
{
namespace
{
bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/** The digits of the number that begins at `at`, without leading zeros. */
std::string_view numberAt(std::string_view text, std::size_t at)
{
  const auto begin = std::min(text.find_first_not_of('0', at), text.size());
  std::size_t end = begin;
  while (end < text.size() && isDigit(text[end])) ++end;
  return text.substr(begin, end - begin);
}
}  // namespace

bool inNaturalOrder(const std::string& a, const std::string& b)
{
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size())
  {
    if (isDigit(a[i]) && isDigit(b[j]))
    {
      const std::string_view of_a = numberAt(a, i), of_b = numberAt(b, j);
      if (of_a.size() != of_b.size()) return of_a.size() < of_b.size();
      if (of_a != of_b) return of_a < of_b;
      i = static_cast<std::size_t>(of_a.data() + of_a.size() - a.data());
      j = static_cast<std::size_t>(of_b.data() + of_b.size() - b.data());
      continue;
    }
    if (a[i] != b[j]) return a[i] < b[j];
    ++i, ++j;
  }
  const std::size_t left_of_a = a.size() - i, left_of_b = b.size() - j;
  return left_of_a != left_of_b ? left_of_a < left_of_b : a < b;  // 01 and 1 are different files
}
}  // namespace scanloom
