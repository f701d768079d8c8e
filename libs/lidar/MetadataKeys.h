/** Typed look-ups in a metadata file, with errors that a person can act on. */
#pragma once
#include <nlohmann/json.hpp>

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** The whole file; throws std::invalid_argument with its path if it can't be read. */
std::string readMetadataText(const std::string& path);

/** Throws std::invalid_argument "NAME: KEY EXPECTED, not VALUE" for whatever is not as asked for. */
class MetadataKeys
{
 public:
  /** Throws if `text` is not a JSON object. */
  MetadataKeys(const std::string& text, std::string name);

  /** Absent where neither the section nor the file's top level has the key; null counts as absent. */
  std::optional<std::string> text(const std::string& section, const std::string& key) const;
  std::optional<int> integer(const std::string& section, const std::string& key, int lowest, int highest) const;
  std::optional<double> number(const std::string& section, const std::string& key, double lowest, double highest) const;
  std::optional<std::vector<double>> numbers(const std::string& section, const std::string& key, double lowest,
                                             double highest) const;

  /** 16 numbers, row by row, the last row 0 0 0 1 and the upper left block a rotation. Translations within 10 m, in mm.
   */
  std::optional<Eigen::Matrix4d> transform(const std::string& section, const std::string& key) const;

  [[noreturn]] void fail(const std::string& key, const std::string& problem) const;

 private:
  const nlohmann::json* find(const std::string& section, const std::string& key) const;

  std::string name_;
  nlohmann::json root_;
};
}  // namespace scanloom
