/** Gathers the mistakes in a file, so that a person gets them all at once. */
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace scanloom
{
/** The mistakes so far, each once: runs of other drives may make the same. */
class Mistakes
{
 public:
  /** @param file that has the section [experiment]. */
  explicit Mistakes(std::string file) : file_(std::move(file)) {}

  /** What `check` throws is due to a key of [experiment]. @return whether it threw nothing. */
  bool inRunsWith(const std::string& key, const std::string& value, const std::function<void()>& check);

  /** What `check` throws names the setting itself. @return as above. */
  bool inSettings(const std::function<void()>& check);

  /** Throws ConfigError with all of them, if there are any. */
  void refuseAny() const;

 private:
  bool collect(const std::function<void()>& check, const std::string& prefix);
  std::string inOurFile(const std::string& problem) const;
  void add(const std::string& problem);

  std::string file_;
  std::vector<std::string> found_;
};
}  // namespace scanloom
