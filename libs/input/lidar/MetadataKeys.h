/** Values of a metadata file by section and key, with their type and range checked. */
#pragma once
#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** The whole file. Throws std::invalid_argument with its path if it cannot be read. */
std::string readMetadataText(const std::string& path);

/** The section of keys in files that have none. */
inline const std::string kTopLevel;

/** Whether this is a JSON object with "lidar": "`maker`". */
bool namesLidar(const std::string& text, const std::string& maker);

/** Its functions throw std::invalid_argument "NAME: KEY: EXPECTED, not VALUE" for a value of another type or range. */
class MetadataKeys
{
 public:
  /** Throws if `text` is not a JSON object. */
  MetadataKeys(const std::string& text, std::string name);
  ~MetadataKeys();

  /** Nothing if neither the section nor the file's top level has the key. null counts as absent. Text is printable. */
  std::optional<std::string> text(const std::string& section, const std::string& key) const;
  std::optional<int> integer(const std::string& section, const std::string& key, int lowest, int highest) const;
  std::optional<double> number(const std::string& section, const std::string& key, double lowest, double highest) const;
  std::optional<std::vector<double>> numbers(const std::string& section, const std::string& key, double lowest,
                                             double highest) const;

  [[noreturn]] void fail(const std::string& key, const std::string& problem) const;

 private:
  const nlohmann::json* find(const std::string& section, const std::string& key) const;

  std::string name_;
  std::unique_ptr<const nlohmann::json> root_;
};
}  // namespace scanloom
