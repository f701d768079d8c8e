#include "base/core/OutputFile.h"

#include "base/core/ConfigError.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;

[[noreturn]] void fail(const Path& file, const std::string& reason)
{
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", file.string(), reason));
}

/** A program before this one may have had its process id, and left a file. */
Path createTemporary(const Path& file)
{
  for (;;)
  {
    const Path temporary = freeNameBeside(file, fmt::format("partial-{}", ::getpid()));
    const int descriptor = createNew(temporary);
    if (descriptor < 0 && errno == EEXIST) continue;  // another thread was faster
    if (descriptor < 0) fail(file, std::strerror(errno));
    ::close(descriptor);
    return temporary;
  }
}

bool isBeingWritten(const Path& file)
{
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;  // a link, for example
  const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return locked;
}

/** Returns its new name; empty if nothing has the name. */
Path setAside(const Path& part)
{
  if (!isTaken(part)) return {};
  if (isBeingWritten(part))
    throw std::runtime_error(
        fmt::format("{}: another program is writing it: wait for its end, or give another output", part.string()));
  const Path name = freeName([&](int number) { return fmt::format("{}.{}", part.string(), number); });
  std::filesystem::rename(part, name);
  return name;
}

/** Up to and including the last line break. */
std::uintmax_t lengthOfLines(const Path& text)
{
  std::ifstream file(text, std::ios::binary);
  std::uintmax_t length = 0, read = 0;
  for (char c = 0; file.get(c);)
  {
    ++read;
    if (c == '\n') length = read;
  }
  return length;
}
}  // namespace

OutputFile::OutputFile(Path file, Uncommitted uncommitted)
  : file_(std::move(file)), removed_at_end_(uncommitted == Uncommitted::IsRemoved)
{
  if (removed_at_end_)
  {
    if (std::filesystem::is_directory(file_)) fail(file_, std::strerror(EISDIR));
    temporary_ = createTemporary(file_);
    return;
  }
  temporary_ = file_.string() + ".part";
  earlier_ = setAside(temporary_);
  locked_ = createNew(temporary_);
  if (locked_ < 0) fail(temporary_, std::strerror(errno));
  ::flock(locked_, LOCK_EX | LOCK_NB);  // some file systems have no locks
}

OutputFile::~OutputFile()
{
  if (locked_ >= 0) ::close(locked_);
  std::error_code ignored;  // a destructor cannot report it
  if (removed_at_end_) std::filesystem::remove(temporary_, ignored);
}

int OutputFile::descriptor() const
{
  const int copy = ::fcntl(locked_, F_DUPFD_CLOEXEC, 0);
  if (copy < 0) fail(temporary_, std::strerror(errno));
  return copy;
}

std::ostream& OutputFile::stream()
{
  if (!stream_.is_open()) stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_.is_open()) fail(file_, std::strerror(errno));
  return stream_;
}

void OutputFile::flush()
{
  errno = 0;
  stream_.flush();
  requireWritten();
}

Path OutputFile::commit(Completeness completeness)
{
  return completeness == Completeness::Partial && isTaken(file_) ? commitBeside() : commitAs(file_);
}

Path OutputFile::commitBeside() { return commitAs(partialNameBeside(file_)); }

Path OutputFile::commitAs(const Path& name)
{
  closeStream();
  try
  {
    flushToDisk(temporary_);
    std::filesystem::rename(temporary_, name);
    removed_at_end_ = false;
    return name;
  }
  catch (const std::system_error& error)
  {
    fail(file_, error.code().message());
  }
}

void OutputFile::commitConverted(const Convert& convert)
{
  closeStream();
  OutputFile converted(file_);
  convert(temporary_, converted.temporary());
  converted.commit();
}

void OutputFile::commitLines()
{
  stream_.close();
  stream_.clear();  // that it could not be written is known
  std::filesystem::resize_file(temporary_, lengthOfLines(temporary_));
  commitAs(file_);
}

void OutputFile::closeStream()
{
  if (!stream_.is_open()) return;
  if (stream_) errno = 0;  // else it is the reason why an earlier write failed
  stream_.close();
  requireWritten();
}

void OutputFile::requireWritten() const
{
  if (!stream_) fail(file_, std::strerror(errno != 0 ? errno : EIO));
}

std::vector<Path> commitTogether(std::list<OutputFile>& files, Completeness completeness)
{
  std::vector<Path> names;
  bool beside = false;
  for (OutputFile& file : files) beside |= completeness == Completeness::Partial && isTaken(file.name());
  for (OutputFile& file : files) names.push_back(beside ? file.commitBeside() : file.commit());
  return names;
}

void writeAtomically(const Path& file, const std::function<void(std::ostream&)>& write)
{
  OutputFile output(file);
  write(output.stream());
  output.commit();
}

void refuseExisting(const std::vector<Path>& files, bool overwrite)
{
  if (overwrite) return;
  std::vector<std::string> existing;
  for (const auto& file : files)
    if (isTaken(file)) existing.push_back(file.string());
  if (existing.empty()) return;
  throw UsageError(fmt::format("{} {} already: give -w to overwrite", fmt::join(existing, ", "),
                               existing.size() == 1 ? "exists" : "exist"));
}

void refuseInputsAsOutputs(const std::vector<Path>& inputs, const std::vector<Path>& outputs)
{
  for (const auto& output : outputs)
    for (const auto& input : inputs)
    {
      std::error_code missing;
      if (std::filesystem::equivalent(input, output, missing))
        throw UsageError(fmt::format("{}: is also read by this command, as {}: give the output another name",
                                     output.string(), input == output ? "its input" : input.string()));
    }
}
}  // namespace scanloom
