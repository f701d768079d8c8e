#include "base/core/OutputFolder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;

Path createdWithin(const Path& folder)
{
  std::filesystem::create_directories(folder);
  for (;;)
  {
    const Path running = freeNameBeside(folder / "running", std::to_string(::getpid()));
    if (std::filesystem::create_directory(running)) return running;
  }
}
}  // namespace

OutputFolder::OutputFolder(Path folder) : folder_(std::move(folder)), running_(createdWithin(folder_)) {}

OutputFolder::~OutputFolder()
{
  std::error_code ignored;  // a destructor cannot report it
  if (!committed_) std::filesystem::remove_all(running_, ignored);
}

bool OutputFolder::holdsAny(const std::vector<std::string>& names) const
{
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return isTaken(folder_ / name); });
}

Path OutputFolder::commit(const std::vector<std::string>& names, Completeness completeness)
{
  Path results = folder_;
  if (completeness == Completeness::Partial && holdsAny(names))
  {
    results =
        freeName([&](int number) { return folder_ / (number > 1 ? fmt::format("partial-{}", number) : "partial"); });
    std::filesystem::rename(running_, results);
  }
  else
    move(names);
  committed_ = true;
  return results;
}

void OutputFolder::move(const std::vector<std::string>& names)
{
  for (auto name = names.rbegin(); name != names.rend(); ++name)
    if (*name == names.back() || !isTaken(running_ / *name)) std::filesystem::remove_all(folder_ / *name);
  for (const std::string& name : names)
    if (isTaken(running_ / name))
    {
      std::filesystem::create_directories((folder_ / name).parent_path());
      if (std::filesystem::is_directory(folder_ / name)) std::filesystem::remove_all(folder_ / name);
      std::filesystem::rename(running_ / name, folder_ / name);
    }
  std::filesystem::remove_all(running_);  // nothing but folders is left
}
}  // namespace scanloom
