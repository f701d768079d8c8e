/** Sound files of every format, made by the program itself, and what each verb does with them. */
#pragma once
#include "mutate.h"

#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
/** One verb on one file. In `arguments`, {} stands for the damaged file; other names are those of the world. */
struct Target
{
  std::string file;
  Content content;
  std::string arguments;

  /** "doctor drive.rawlog --json" */
  std::string name() const;
};

const std::vector<Target>& targets();

/** Writes all files that the targets name into a new folder. Throws std::runtime_error if a verb fails on sound files.
 */
void makeWorld(const std::filesystem::path& scanloom, const std::filesystem::path& folder);

/** The words between spaces; quotes keep words together. */
std::vector<std::string> wordsOf(const std::string& command);
}  // namespace scanloom
