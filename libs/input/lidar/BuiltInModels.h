/** Models whose metadata the program has with it: the files of params/lidars/, compiled in. */
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanloom
{
struct BuiltInModel
{
  std::string_view name;      // "VLP-16"
  std::string_view metadata;  // the text of its file
};

/** In alphabetical order of their files. Written by CMake. */
std::vector<BuiltInModel> builtInModels();

/** "VLP-16, XT32, ..." for messages. */
std::string namesOfBuiltInModels();

/**
 * The metadata of a built-in model, compared without case; "XT32 dual" is one that is set to two returns, "VLP-16 1200
 * rpm" and "XT32 dual 1200 rpm" one whose rotor is set to 1200 revolutions per minute. Nothing if there is none of that
 * name.
 */
std::optional<std::string> builtInMetadata(const std::string& name);

/**
 * The text of a file, or of a built-in model if `file_or_model` has no path separator and does not end in ".json" and
 * there is no such file. Throws std::invalid_argument if it is neither; then it names all models.
 */
std::string metadataText(const std::string& file_or_model);
}  // namespace scanloom
