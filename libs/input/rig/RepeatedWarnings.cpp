#include "input/rig/RepeatedWarnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace scanloom
{
namespace
{
constexpr std::size_t kMostKnown = 1000;  // their texts may be of others' making

std::string again(const std::string& warning, std::size_t times)
{
  return times == 1 ? warning : fmt::format("{} ({} times since the last such line)", warning, times);
}
}  // namespace

std::string withoutNumbers(std::string warning)
{
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  warning.erase(std::remove_if(warning.begin(), warning.end(), is_digit), warning.end());
  return warning;
}

std::optional<std::string> RepeatedWarnings::toSay(const std::string& warning, Clock::time_point now)
{
  constexpr auto kSayAgainAfter = std::chrono::minutes(1);
  if (known_.size() >= kMostKnown) known_.clear();
  const auto [known, is_new] = known_.try_emplace(withoutNumbers(warning), Counted{warning, 0, now});
  if (is_new) return warning;
  Counted& counted = known->second;
  counted.newest = warning;
  ++counted.unsaid;
  if (now - counted.said < kSayAgainAfter) return std::nullopt;
  counted.said = now;
  return again(warning, std::exchange(counted.unsaid, 0));
}

std::vector<std::string> RepeatedWarnings::unsaid()
{
  std::vector<std::string> texts;
  for (auto& [key, counted] : known_)
    if (counted.unsaid > 0) texts.push_back(again(counted.newest, std::exchange(counted.unsaid, 0)));
  return texts;
}
}  // namespace scanloom
