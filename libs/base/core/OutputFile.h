/** A stream to a file that gets its name only when it is complete. */
#pragma once
#include "base/core/AtomicFile.h"

#include <fstream>
#include <functional>

namespace scanloom
{
/** For results that are written during a run. For a file that is written at once there is writeAtomically(). */
class OutputFile
{
 public:
  /** Throws std::runtime_error with path and reason if the file cannot be written. */
  explicit OutputFile(const std::filesystem::path&);

  std::ostream& stream() { return stream_; }

  /** Throws std::runtime_error if not all bytes could be written: a full disk is noticed at once. */
  void flush();

  /** Gives the file its name. No write may follow. Throws std::runtime_error if not all bytes could be written. */
  void commit();

  /** Reads the first file and writes the second. */
  using Convert = std::function<void(const std::filesystem::path& written, const std::filesystem::path& converted)>;

  /** As commit(), but what `convert` makes of the file gets the name. Throws what `convert` throws, too. */
  void commitConverted(const Convert& convert);

  /** The same for a text that could not be written to its end: with the whole lines that it has. */
  void commitLines();

 private:
  void closeStream();
  void requireWritten() const;

  std::filesystem::path path_;
  AtomicFile file_;
  std::ofstream stream_;
};
}  // namespace scanloom
