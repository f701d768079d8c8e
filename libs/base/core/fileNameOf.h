#pragma once
#include <string>

namespace scanloom
{
/**
 * The name of a file or a folder for what data call `label`: one name within a folder, whatever the label is. '/',
 * '\\', '%', control characters and a leading '.' become %2F and the like, and what a file system would find too long
 * ends with a digest; different labels have different names.
 */
std::string fileNameOf(const std::string& label);
}  // namespace scanloom
