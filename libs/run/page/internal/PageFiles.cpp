#include "run/page/internal/PageFiles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;

struct Wanted
{
  const char *request, *file, *type;
};

constexpr const char *kHtml = "text/html; charset=utf-8", *kCss = "text/css; charset=utf-8",
                     *kScript = "text/javascript; charset=utf-8";
constexpr std::array kPage{Wanted{"/", "index.html", kHtml},           Wanted{"/page.css", "page.css", kCss},
                           Wanted{"/page.js", "page.js", kScript},     Wanted{"/scene.js", "scene.js", kScript},
                           Wanted{"/stream.js", "stream.js", kScript}, Wanted{"/panel.js", "panel.js", kScript},
                           Wanted{"/map.js", "map.js", kScript},       Wanted{"/player.js", "player.js", kScript},
                           Wanted{"/site.html", "site.html", kHtml},   Wanted{"/site.js", "site.js", kScript},
                           Wanted{"/choice.js", "choice.js", kScript}};

constexpr const char* kThreeFolder = "/usr/share/javascript/three";
constexpr std::array kThree{Wanted{"/three.min.js", "three.min.js", kScript},
                            Wanted{"/OrbitControls.js", "examples/js/controls/OrbitControls.js", kScript}};

PageFile read(const Path& path, const char* type)
{
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file || bytes.empty()) throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));
  return {type, std::move(bytes)};
}

Path folderWithPage(const std::vector<Path>& folders)
{
  for (const Path& folder : folders)
    if (std::filesystem::exists(folder / kPage.front().file)) return folder;
  throw std::runtime_error(fmt::format("the page for --web is in none of {}: install scanloom whole",
                                       fmt::join(std::vector<std::string>(folders.begin(), folders.end()), ", ")));
}
}  // namespace

std::vector<Path> pageFolders()
{
  std::error_code none;
  const Path program = std::filesystem::read_symlink("/proc/self/exe", none);
  return {program.parent_path().parent_path() / "share/scanloom/page", SCANLOOM_PAGE_SOURCE};
}

PageFiles readPage(const std::vector<Path>& folders)
{
  const Path folder = folderWithPage(folders);
  PageFiles files;
  for (const Wanted& wanted : kPage) files[wanted.request] = read(folder / wanted.file, wanted.type);
  if (!std::filesystem::exists(Path(kThreeFolder) / kThree.front().file))
    throw std::runtime_error(
        fmt::format("{} is not there, which --web needs: install the package libjs-three", kThreeFolder));
  for (const Wanted& wanted : kThree) files[wanted.request] = read(Path(kThreeFolder) / wanted.file, wanted.type);
  return files;
}
}  // namespace scanloom
