#include "base/core/AtomicFile.h"

#include "base/core/ConfigError.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace scanloom
{
namespace
{
[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason)
{
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", file.string(), reason));
}

/** A program before this one may have had its process id, and left a file. */
std::filesystem::path createTemporary(const std::filesystem::path& file)
{
  for (;;)
  {
    const std::filesystem::path temporary = freeNameBeside(file, fmt::format("partial-{}", ::getpid()));
    const int descriptor = createNew(temporary);
    if (descriptor < 0 && errno == EEXIST) continue;  // another thread was faster
    if (descriptor < 0) fail(file, std::strerror(errno));
    ::close(descriptor);
    return temporary;
  }
}
}  // namespace

AtomicFile::AtomicFile(std::filesystem::path file) : file_(std::move(file))
{
  if (std::filesystem::is_directory(file_)) fail(file_, std::strerror(EISDIR));
  temporary_ = createTemporary(file_);
}

AtomicFile::~AtomicFile()
{
  std::error_code ignored;  // a destructor cannot report it
  if (!committed_) std::filesystem::remove(temporary_, ignored);
}

std::filesystem::path AtomicFile::commit(Completeness completeness)
{
  return completeness == Completeness::Partial && isTaken(file_) ? commitBeside() : commitAs(file_);
}

std::filesystem::path AtomicFile::commitBeside() { return commitAs(partialNameBeside(file_)); }

std::filesystem::path AtomicFile::commitAs(const std::filesystem::path& name)
{
  try
  {
    flushToDisk(temporary_);
    std::filesystem::rename(temporary_, name);
    committed_ = true;
    return name;
  }
  catch (const std::system_error& error)
  {
    fail(file_, error.code().message());
  }
}

void writeAtomically(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write)
{
  AtomicFile atomic(file);
  errno = 0;
  std::ofstream stream(atomic.temporary(), std::ios::binary);
  write(stream);
  stream.close();
  if (!stream) fail(file, std::strerror(errno != 0 ? errno : EIO));
  atomic.commit();
}

void refuseExisting(const std::vector<std::filesystem::path>& files, bool overwrite)
{
  if (overwrite) return;
  std::vector<std::string> existing;
  for (const auto& file : files)
    if (isTaken(file)) existing.push_back(file.string());
  if (existing.empty()) return;
  throw UsageError(fmt::format("{} {} already: give -w to overwrite", fmt::join(existing, ", "),
                               existing.size() == 1 ? "exists" : "exist"));
}

void refuseInputsAsOutputs(const std::vector<std::filesystem::path>& inputs,
                           const std::vector<std::filesystem::path>& outputs)
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
