/** Files that get their name only when they are complete. */
#pragma once
#include "base/core/NewFile.h"

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <vector>

namespace scanloom
{
/**
 * A new file under a temporary name in the same folder, with the same extension (some writers choose their format by
 * it). commit() gives it its name; without commit() it is removed.
 */
class AtomicFile
{
 public:
  /** Creates the temporary file. Throws std::runtime_error if the folder is missing or cannot be written. */
  explicit AtomicFile(std::filesystem::path file);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  const std::filesystem::path& temporary() const { return temporary_; }

  /**
   * Replaces an existing file of the name; a partial file is put beside it instead. The writer must have closed the
   * file. @return the name that the file has now. Throws std::runtime_error.
   */
  std::filesystem::path commit(Completeness = Completeness::Whole);

  /** Puts the file beside the one of its name, if there is one or not: `map.partial.bt`. */
  std::filesystem::path commitBeside();

 private:
  std::filesystem::path commitAs(const std::filesystem::path& name);

  std::filesystem::path file_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/** Writes a whole file by `write`. Throws std::runtime_error if the disk is full, and what `write` throws. */
void writeAtomically(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/** To be called before the work begins. Throws UsageError that names all files that exist, unless `overwrite`. */
void refuseExisting(const std::vector<std::filesystem::path>& files, bool overwrite);

/** To be called before any file is opened. Throws UsageError if an output is, by whatever name, one of the inputs. */
void refuseInputsAsOutputs(const std::vector<std::filesystem::path>& inputs,
                           const std::vector<std::filesystem::path>& outputs);
}  // namespace scanloom
