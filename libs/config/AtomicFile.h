/** Files that appear under their name only when they are complete. */
#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <vector>

namespace scanloom
{
/**
 * A file under construction. It is written under a temporary name in the same folder (with the same extension, by
 * which some writers choose their format), and gets its name by commit(); without that it is removed.
 */
class AtomicFile
{
 public:
  /** Creates the temporary file. @throws std::runtime_error if the folder is missing or cannot be written. */
  explicit AtomicFile(std::filesystem::path file);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  const std::filesystem::path& temporary() const { return temporary_; }

  /** Replaces what has the name. The writer must have closed the file. @throws std::runtime_error */
  void commit();

 private:
  std::filesystem::path file_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/** For what is written in one go. @throws std::runtime_error if the disk is full; what `write` throws passes through.
 */
void writeAtomically(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/** Asked before the work begins. @throws UsageError naming every file that exists, unless they may be overwritten. */
void refuseExisting(const std::vector<std::filesystem::path>& files, bool overwrite);
}  // namespace scanloom
