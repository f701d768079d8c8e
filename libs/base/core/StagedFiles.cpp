#include "base/core/StagedFiles.h"

#include <algorithm>

namespace scanloom
{
using Paths = std::vector<std::filesystem::path>;

StagedFiles::StagedFiles(const Paths& files) : files_(files)
{
  for (const auto& file : files_) atomic_.emplace_back(file);
}

Paths StagedFiles::running() const
{
  Paths paths;
  for (const AtomicFile& file : atomic_) paths.push_back(file.temporary());
  return paths;
}

Paths StagedFiles::commit(Completeness completeness)
{
  const bool beside = completeness == Completeness::Partial && std::any_of(files_.begin(), files_.end(), &isTaken);
  Paths names;
  for (AtomicFile& file : atomic_) names.push_back(beside ? file.commitBeside() : file.commit());
  return names;
}
}  // namespace scanloom
