/** A stream to a file that gets its name only when it is complete. */
#pragma once
#include "core/AtomicFile.h"

#include <fstream>

namespace scanloom
{
/** For results that are written during a run. For a file that is written at once there is writeAtomically(). */
class OutputFile
{
 public:
  /** Throws std::runtime_error with path and reason if the file cannot be written. */
  explicit OutputFile(const std::filesystem::path&);

  std::ostream& stream() { return stream_; }

  /** Gives the file its name. No write may follow. Throws std::runtime_error if not all bytes could be written. */
  void commit();

 private:
  std::filesystem::path path_;
  AtomicFile file_;
  std::ofstream stream_;
};
}  // namespace scanloom
