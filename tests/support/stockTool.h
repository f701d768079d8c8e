/** Programs that are not ours, as judges: tests skip where they are not installed. */
#pragma once
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace scanloom
{
inline bool isInstalled(const std::string& program)
{
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/** The lines that `command` prints to stdout; throws if it does not end with 0. */
inline std::vector<std::string> linesOf(const std::string& command)
{
  FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  if (!pipe) throw std::runtime_error(command);
  std::string all;
  char chunk[65536];
  for (std::size_t n; (n = std::fread(chunk, 1, sizeof chunk, pipe)) > 0;) all.append(chunk, n);
  if (pclose(pipe) != 0) throw std::runtime_error("failed: " + command);

  std::vector<std::string> lines;
  std::istringstream text(all);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}
}  // namespace scanloom

#define SCANLOOM_NEEDS_TOOL(program) \
  if (!scanloom::isInstalled(program)) GTEST_SKIP() << program << " is not installed"
