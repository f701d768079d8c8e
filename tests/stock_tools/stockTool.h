/** MRPT's own programs, run as a user runs them. Their exit status says little: tests look at what comes out. */
#pragma once
#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <mrpt/version.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>

namespace scanloom
{
inline bool isInstalled(const std::string& program)
{
  std::istringstream folders(std::getenv("PATH") ? std::getenv("PATH") : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

/** Since 2.13.0 rawlog-edit filters a copy of each object and writes the original (CRawlogProcessor.h). */
inline constexpr bool kStockFiltersRemove = MRPT_VERSION < 0x20d00;

/** What the command printed, on both streams. */
inline std::string outputOf(const std::string& command)
{
  std::string output;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return output;
  char chunk[4096];
  while (const std::size_t got = fread(chunk, 1, sizeof chunk, pipe)) output.append(chunk, got);
  pclose(pipe);
  return output;
}

/** A named pipe that stays open and empty: rawlog-grabber ends at once if its input is closed, or at a key. */
class OpenInput
{
 public:
  explicit OpenInput(const std::filesystem::path& path) : path_(path)
  {
    if (mkfifo(path.c_str(), 0600) == 0) file_ = open(path.c_str(), O_RDWR);
  }
  OpenInput(const OpenInput&) = delete;
  OpenInput& operator=(const OpenInput&) = delete;
  ~OpenInput() { close(file_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int file_ = -1;
};

/** Of `rawlog-edit --info`: how often a label occurs; -1 if it is not there. */
inline int occurrences(const std::string& info, const std::string& label)
{
  std::smatch found;
  const std::regex line("Occurs/Rate/Durat[.]\\) : +" + label + " */ *([0-9]+) ");
  return std::regex_search(info, found, line) ? std::stoi(found[1]) : -1;
}

inline std::string rawlogEdit(const std::string& arguments)
{
  return outputOf("rawlog-edit -p " SCANLOOM_PLUGIN " " + arguments);
}
}  // namespace scanloom

#define SCANLOOM_NEEDS_PROGRAM(name) \
  if (!scanloom::isInstalled(name)) GTEST_SKIP() << name << " is not installed (package mrpt-apps)"
