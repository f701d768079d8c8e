#include "base/core/NewFile.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace scanloom
{
bool isTaken(const std::filesystem::path& path)
{
  std::error_code ignored;  // a text too long for a name is no name
  return std::filesystem::exists(std::filesystem::symlink_status(path, ignored));
}

std::filesystem::path freeName(const std::function<std::filesystem::path(int)>& numbered)
{
  int number = 1;
  while (isTaken(numbered(number))) ++number;
  return numbered(number);
}

std::filesystem::path freeNameBeside(const std::filesystem::path& file, const std::string& mark)
{
  return freeName(
      [&](int number)
      {
        const std::string count = number > 1 ? fmt::format("-{}", number) : "";
        return file.parent_path() /
               fmt::format("{}.{}{}{}", file.stem().string(), mark, count, file.extension().string());
      });
}

int createNew(const std::filesystem::path& path)
{
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

void flushToDisk(const std::filesystem::path& file)
{
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), file.string());
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (error != 0 && error != EINVAL && error != EROFS)  // some file systems cannot sync
    throw std::system_error(error, std::generic_category(), file.string());
}

std::filesystem::path partialNameBeside(const std::filesystem::path& file) { return freeNameBeside(file, "partial"); }
}  // namespace scanloom
