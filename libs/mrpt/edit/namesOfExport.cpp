#include "mrpt/edit/namesOfExport.h"

#include <algorithm>
#include <set>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;

/** `000012.ply`, `000012.bin`: a cloud in a row of clouds. */
bool isNumbered(const Path& file)
{
  const std::string stem = file.stem().string();
  return stem.size() >= 6 &&
         std::all_of(stem.begin(), stem.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::set<Path> filesWithin(const Path& folder)
{
  std::set<Path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (!entry.is_directory()) files.insert(entry.path().lexically_relative(folder));
  return files;
}

/** The numbered files beside which the new ones will be. */
std::set<Path> earlierClouds(const Path& folder, const std::set<Path>& written)
{
  std::set<Path> rows;
  for (const Path& file : written)
    if (isNumbered(file)) rows.insert(file.parent_path());
  std::set<Path> earlier;
  for (const Path& row : rows)
    if (std::filesystem::is_directory(folder / row))
      for (const auto& entry : std::filesystem::directory_iterator(folder / row))
        if (isNumbered(entry.path())) earlier.insert(row / entry.path().filename());
  return earlier;
}

}  // namespace

std::vector<std::string> namesOfExport(const Path& folder, const Path& running)
{
  std::set<Path> files = filesWithin(running);
  files.merge(earlierClouds(folder, files));
  std::vector<std::string> names;
  for (const Path& file : files) names.push_back(file.string());
  std::stable_partition(names.begin(), names.end(), [](const std::string& name) { return isNumbered(name); });
  return names;
}
}  // namespace scanloom
