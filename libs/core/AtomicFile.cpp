#include "core/AtomicFile.h"

#include "core/ConfigError.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace scanloom
{
namespace
{
std::filesystem::path temporaryNameOf(const std::filesystem::path& file)
{
  const auto name = fmt::format("{}.partial-{}{}", file.stem().string(), ::getpid(), file.extension().string());
  return file.parent_path() / name;
}

[[noreturn]] void fail(const std::filesystem::path& file, int error)
{
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", file.string(), std::strerror(error)));
}

/** Without this, a power cut after the rename may leave an empty file under the final name. */
void flushToDisk(const std::filesystem::path& file)
{
  const int descriptor = ::open(file.c_str(), O_RDONLY);
  if (descriptor < 0) fail(file, errno);
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (error != 0 && error != EINVAL && error != EROFS) fail(file, error);  // some file systems cannot sync
}
}  // namespace

AtomicFile::AtomicFile(std::filesystem::path file) : file_(std::move(file)), temporary_(temporaryNameOf(file_))
{
  if (std::filesystem::is_directory(file_)) fail(file_, EISDIR);
  const int descriptor = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(file_, errno);
  ::close(descriptor);
}

AtomicFile::~AtomicFile()
{
  std::error_code ignored;  // a destructor cannot report it
  if (!committed_) std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit()
{
  flushToDisk(temporary_);
  if (std::rename(temporary_.c_str(), file_.c_str()) != 0) fail(file_, errno);
  committed_ = true;
}

void writeAtomically(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write)
{
  AtomicFile atomic(file);
  errno = 0;
  std::ofstream stream(atomic.temporary(), std::ios::binary);
  write(stream);
  stream.close();
  if (!stream) fail(file, errno != 0 ? errno : EIO);
  atomic.commit();
}

void refuseExisting(const std::vector<std::filesystem::path>& files, bool overwrite)
{
  if (overwrite) return;
  std::vector<std::string> existing;
  for (const auto& file : files)
    if (std::filesystem::exists(file)) existing.push_back(file.string());
  if (existing.empty()) return;
  throw UsageError(fmt::format("{} {} already: give -w to overwrite", fmt::join(existing, ", "),
                               existing.size() == 1 ? "exists" : "exist"));
}
}  // namespace scanloom
