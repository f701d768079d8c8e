/** The files of an export, which appear together. */
#pragma once
#include "base/core/ResultFolder.h"
#include "base/core/StagedFiles.h"
#include "mrpt/edit/EditOperations.h"

#include <optional>

namespace scanloom
{
class StagedOutputs
{
 public:
  explicit StagedOutputs(const EditOutputs&);

  /** Where the operation writes in place of its outputs. */
  EditOutputs running() const;

  /**
   * As StagedFiles and ResultFolder have it. Clouds of an earlier export to the same folders go, also those with higher
   * numbers. @return where the outputs are.
   */
  EditOutputs commit(Completeness);

 private:
  EditOutputs outputs_;
  StagedFiles files_;
  std::optional<ResultFolder> folder_;
};
}  // namespace scanloom
