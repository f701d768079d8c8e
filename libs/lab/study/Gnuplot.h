/** Draws gnuplot scripts, which have no `set terminal`. */
#pragma once
#include "base/core/ScratchFolder.h"

#include <filesystem>
#include <string>

namespace scanloom
{
/**
 * The text, from data or a path, as a string of gnuplot's language. It is in single quotes, within which gnuplot
 * substitutes nothing; in double quotes a back quote would start a shell command. A text that begins with a quote comes
 * after a space. Throws std::invalid_argument if the text has control characters or is no UTF-8: a line break would end
 * the string.
 */
std::string gnuplotString(const std::string& text);

/** Keeps its files in a temporary folder, which its destructor removes. */
class Gnuplot
{
 public:
  /** Throws std::runtime_error if no folder can be created in `parent`. */
  explicit Gnuplot(const std::filesystem::path& parent) : folder_(parent, "report") {}

  /**
   * An <svg> element whose ids differ from those of all earlier ones, so that several can be on one page.
   * Throws std::runtime_error with the messages of gnuplot if it fails.
   */
  std::string draw(const std::string& script);

  /**
   * Draws a square figure into a new file; its ending is the format, .svg or .png. Throws std::invalid_argument for
   * another ending, and as draw() does.
   */
  void drawInto(const std::filesystem::path&, const std::string& script);

 private:
  void run(const std::string& terminal, const std::filesystem::path& output, const std::string& script) const;

  ScratchFolder folder_;
  int figures_ = 0;
};
}  // namespace scanloom
