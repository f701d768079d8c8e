/** A stream into a file that appears under its name only when it is whole. */
#pragma once
#include "config/AtomicFile.h"

#include <fstream>

namespace scanloom
{
/** For results that grow while a run lasts; what is written in one go uses writeAtomically(). */
class OutputFile
{
 public:
  /** Throws std::runtime_error, with the path and the reason, if it cannot be written. */
  explicit OutputFile(const std::filesystem::path&);

  std::ostream& stream() { return stream_; }

  /** Gives the file its name; throws std::runtime_error if not every byte reached the disk. No write may follow. */
  void commit();

 private:
  std::filesystem::path path_;
  AtomicFile file_;
  std::ofstream stream_;
};
}  // namespace scanloom
