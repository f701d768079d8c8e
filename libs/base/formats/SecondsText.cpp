#include "base/formats/SecondsText.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace scanloom
{
namespace
{
constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr std::int64_t kMostSeconds = kFarthestStamp.count() / kNanosecondsPerSecond;
constexpr std::size_t kDecimals = 9;

std::optional<std::int64_t> parseDigits(const std::string& text)
{
  std::int64_t value = 0;
  const bool only_digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  if (!only_digits || std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc{})
    return std::nullopt;
  return value;
}

std::optional<Timestamp> parseWithExponent(const std::string& text)
{
  char* end = nullptr;
  const long double value = std::strtold(text.c_str(), &end);
  if (end != text.c_str() + text.size() || !(std::fabs(value) < kMostSeconds)) return std::nullopt;
  return fromNanoseconds(std::llround(value * kNanosecondsPerSecond));
}
}  // namespace

std::string secondsText(Timestamp stamp)
{
  const std::int64_t ns = nanoseconds(stamp);
  const std::int64_t magnitude = std::abs(ns);
  return fmt::format("{}{}.{:09}", ns < 0 ? "-" : "", magnitude / kNanosecondsPerSecond,
                     magnitude % kNanosecondsPerSecond);
}

std::optional<Timestamp> parseSeconds(const std::string& text)
{
  if (text.find_first_of("eE") != std::string::npos) return parseWithExponent(text);

  const std::size_t sign = text.rfind('-', 0) == 0 ? 1 : 0;
  const std::size_t point = std::min(text.find('.'), text.size());
  std::string decimals = text.substr(std::min(point + 1, text.size()));
  decimals.resize(std::max(decimals.size(), kDecimals), '0');

  const auto whole = parseDigits(text.substr(sign, point - std::min(sign, point)));
  const auto fraction = parseDigits(decimals.substr(0, kDecimals));
  if (!whole || !fraction || *whole >= kMostSeconds) return std::nullopt;
  const std::int64_t ns = *whole * kNanosecondsPerSecond + *fraction;
  return fromNanoseconds(sign ? -ns : ns);
}
}  // namespace scanloom
