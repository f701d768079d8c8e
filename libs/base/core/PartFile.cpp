#include "base/core/PartFile.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace scanloom
{
namespace
{
bool isBeingWritten(const std::filesystem::path& file)
{
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;  // a link, for example
  const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return locked;
}

/** Returns its new name; empty if nothing has the name. */
std::filesystem::path setAside(const std::filesystem::path& part)
{
  if (!isTaken(part)) return {};
  if (isBeingWritten(part))
    throw std::runtime_error(
        fmt::format("{}: another program is writing it: wait for its end, or give another output", part.string()));
  const auto name = freeName([&](int number) { return fmt::format("{}.{}", part.string(), number); });
  std::filesystem::rename(part, name);
  return name;
}

[[noreturn]] void refusePart(const std::filesystem::path& file, const std::string& reason)
{
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", file.string(), reason));
}
}  // namespace

PartFile::PartFile(std::filesystem::path file)
  : file_(std::move(file)), part_(file_.string() + ".part"), earlier_(setAside(part_)), locked_(createNew(part_))
{
  if (locked_ < 0) refusePart(part_, std::strerror(errno));
  ::flock(locked_, LOCK_EX | LOCK_NB);  // some file systems have no locks
}

PartFile::~PartFile()
{
  if (locked_ >= 0) ::close(locked_);
}

int PartFile::descriptor() const
{
  const int copy = ::fcntl(locked_, F_DUPFD_CLOEXEC, 0);
  if (copy < 0) refusePart(part_, std::strerror(errno));
  return copy;
}

std::filesystem::path PartFile::commit(Completeness completeness)
{
  try
  {
    flushToDisk(part_);
    const bool beside = completeness == Completeness::Partial && isTaken(file_);
    const std::filesystem::path name = beside ? partialNameBeside(file_) : file_;
    std::filesystem::rename(part_, name);
    return name;
  }
  catch (const std::system_error& error)
  {
    refusePart(file_, error.code().message());
  }
}
}  // namespace scanloom
