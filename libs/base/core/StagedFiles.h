/** Several files of one run that get their names together. */
#pragma once
#include "base/core/AtomicFile.h"

#include <list>
#include <vector>

namespace scanloom
{
class StagedFiles
{
 public:
  /** Throws as AtomicFile does. */
  explicit StagedFiles(const std::vector<std::filesystem::path>& files);

  /** Where they are to be written, in the order of the files; each has the ending of its file. */
  std::vector<std::filesystem::path> running() const;

  /** As AtomicFile::commit; but if one partial file would replace another, all of them are put beside. */
  std::vector<std::filesystem::path> commit(Completeness);

 private:
  std::vector<std::filesystem::path> files_;
  std::list<AtomicFile> atomic_;
};
}  // namespace scanloom
