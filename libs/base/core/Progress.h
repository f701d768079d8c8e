/** Shows progress: a bar on a terminal, otherwise a line per 10 %. */
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

namespace scanloom
{
bool standardErrorIsTerminal();

class Progress
{
 public:
  /**
   * @param what name of the work, e.g. "slam".
   * @param total of the count that update() gets; 0 if it is not known: then there is neither a bar nor a time left.
   * @param unit of the count, e.g. "scans".
   */
  Progress(std::string what, std::uint64_t total, std::string unit, std::ostream& out = std::cerr,
           bool terminal = standardErrorIsTerminal());
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  void update(std::uint64_t done);

  /** A line that stays, above the one that is shown. */
  void say(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;

  bool isTimeToShow() const;
  std::string line() const;
  void show();

  std::string what_;
  std::uint64_t total_;
  std::string unit_;
  std::ostream& out_;
  bool terminal_;
  std::uint64_t done_ = 0;
  std::uint64_t shown_ = 0;  // count in the latest line
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_at_ = start_;
};

/**
 * The size of all files together, and of those in folders, at least 1: the total for a progress in MB. A missing file
 * counts 0: who opens it says so.
 */
std::uint64_t megabytesOf(const std::vector<std::filesystem::path>& files);

/** `59 s`, `4:07 min`, `2:05 h` */
std::string timeText(double seconds);
}  // namespace scanloom
