#pragma once
#include <filesystem>
#include <string>

namespace scanloom
{
/** A new folder that is removed with all that is in it. */
class ScratchFolder
{
 public:
  /** `parent`/`name`_ and six letters. Throws std::runtime_error if it cannot be made. */
  ScratchFolder(const std::filesystem::path& parent, const std::string& name);
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};
}  // namespace scanloom
