#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace scanloom
{
struct PageFile
{
  std::string type;  // "text/html; charset=utf-8"
  std::string bytes;
};

/** By the path in a request: "/", "/page.css", "/three.min.js". */
using PageFiles = std::map<std::string, PageFile>;

/** Where a program looks for the page: installed beside it, and where it was built. */
std::vector<std::filesystem::path> pageFolders();

/**
 * The page, from the first folder that has it, and three.js, all in memory: a request names one of these files or
 * nothing. Throws std::runtime_error if a file is not there, saying where it was expected.
 */
PageFiles readPage(const std::vector<std::filesystem::path>& folders = pageFolders());
}  // namespace scanloom
