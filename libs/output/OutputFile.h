/** A result appears under its name only when it is whole: written beside it under a temporary name, then renamed. */
#pragma once
#include <filesystem>
#include <fstream>

namespace scanloom
{
class OutputFile
{
 public:
  /** Opens `path` + ".part" for binary writing; throws std::runtime_error, with the path and the reason, if it cannot.
   */
  explicit OutputFile(std::filesystem::path path);

  /** Without a commit() nothing stays behind, and an older file of that name stays as it was. */
  ~OutputFile();

  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ostream& stream() { return stream_; }

  /** For libraries that insist on opening the file themselves; stream() must not be written then. */
  const std::filesystem::path& temporaryPath() const { return temporary_; }

  /** Replaces the file of that name; throws std::runtime_error if not every byte reached the disk (disk full). */
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
};
}  // namespace scanloom
