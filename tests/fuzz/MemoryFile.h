#pragma once
#include "require.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace scanloom
{
/** Takes any content without a disk. Its name matters to some readers: only a link to the memory lies in a folder. */
class MemoryFile
{
 public:
  MemoryFile() : descriptor_(memfd_create("fuzz", 0)), path_("/proc/self/fd/" + std::to_string(descriptor_))
  {
    require(descriptor_ >= 0);
  }
  MemoryFile(const std::filesystem::path& folder, const std::string& name) : MemoryFile()
  {
    std::filesystem::create_symlink(path_, folder / name);
    path_ = folder / name;
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  template <typename Content>
  const std::filesystem::path& holding(const Content& bytes) const
  {
    require(ftruncate(descriptor_, 0) == 0);
    require(pwrite(descriptor_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()));
    return path_;
  }

 private:
  int descriptor_;
  std::filesystem::path path_;
};

/** One for the life of the process. Removed as it ends in good order: after a finding a folder with links stays. */
class FuzzFolder
{
 public:
  FuzzFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "scanloom_fuzz_XXXXXX").string();
    require(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~FuzzFolder() { std::filesystem::remove_all(path_); }
  FuzzFolder(const FuzzFolder&) = delete;
  FuzzFolder& operator=(const FuzzFolder&) = delete;

  operator const std::filesystem::path&() const { return path_; }

 private:
  std::filesystem::path path_;
};
}  // namespace scanloom
