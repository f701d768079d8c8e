/** A folder of results that never holds those of two runs. */
#pragma once
#include "base/core/NewFile.h"

#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * The files of a run are written to a folder of their own within the results' folder, and moved into it together by
 * commit(). Without commit() they are removed.
 */
class OutputFolder
{
 public:
  /** Creates both folders. Throws std::filesystem::filesystem_error. */
  explicit OutputFolder(std::filesystem::path folder);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();

  /** Where the run writes its files. */
  const std::filesystem::path& running() const { return running_; }

  /**
   * `names`: all files and folders that runs of this kind leave, as paths within the folder. The last one is the first
   * to be removed and the last to appear: where it is, all others are of the same run.
   *
   * Whole: the run's files replace those of an earlier run, whose other files are removed. Partial: the same if there
   * are none of an earlier run, else the run's files stay in a folder beside them, `partial`. All files must be closed.
   * @return the folder that they are in. Throws std::filesystem::filesystem_error.
   */
  std::filesystem::path commit(const std::vector<std::string>& names, Completeness);

 private:
  bool holdsAny(const std::vector<std::string>& names) const;
  void move(const std::vector<std::string>& names);

  std::filesystem::path folder_, running_;
  bool committed_ = false;
};
}  // namespace scanloom
