/** A file that is written for hours, and whose beginning is worth keeping if the program dies. */
#pragma once
#include "base/core/NewFile.h"

#include <filesystem>

namespace scanloom
{
/**
 * A new file `<file>.part`; commit() gives it its name. Without commit() it stays. What has the name `<file>.part`
 * already, from a run that died, is first given another name: `<file>.part.1`.
 */
class PartFile
{
 public:
  /** Throws std::runtime_error if it cannot be created, and if another program is writing `<file>.part`. */
  explicit PartFile(std::filesystem::path file);
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  ~PartFile();

  const std::filesystem::path& part() const { return part_; }

  /** Where the part of an earlier run is now; empty: there was none. */
  const std::filesystem::path& earlier() const { return earlier_; }

  /** A descriptor to write to, which the caller closes. */
  int descriptor() const;

  /** As AtomicFile::commit(). */
  std::filesystem::path commit(Completeness);

 private:
  std::filesystem::path file_, part_, earlier_;
  int locked_ = -1;  // the open file: other programs see that it is being written
};
}  // namespace scanloom
