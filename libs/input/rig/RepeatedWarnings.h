#pragma once
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** What warnings have in common that differ in numbers only. */
std::string withoutNumbers(std::string warning);

/** Says a warning once, and from then on at most once a minute how often it came. */
class RepeatedWarnings
{
 public:
  using Clock = std::chrono::steady_clock;

  /** What is to be said now; nothing if it was said a short time ago. Warnings that differ in numbers are the same. */
  std::optional<std::string> toSay(const std::string& warning, Clock::time_point now = Clock::now());

  /** What was not said yet of those that came again; as at the end of a run. */
  std::vector<std::string> unsaid();

 private:
  struct Counted
  {
    std::string newest;
    std::size_t unsaid = 0;
    Clock::time_point said;
  };

  std::map<std::string, Counted> known_;  // by the text without its numbers; bounded
};
}  // namespace scanloom
