#include "lab/study/Gnuplot.h"

#include "base/core/OutputFile.h"
#include "base/core/Text.h"
#include "lab/study/ContentHash.h"
#include "lab/study/internal/Command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <stdexcept>
#include <system_error>

namespace scanloom
{
namespace
{
std::string withPrefixedIds(const std::string& svg, const std::string& prefix)
{
  static const std::regex definition("(\\bid ?= ?['\"])"), reference("((?:href ?= ?['\"]|url\\()#)");
  return std::regex_replace(std::regex_replace(svg, definition, "$1" + prefix), reference, "$1" + prefix);
}
}  // namespace

std::string gnuplotString(const std::string& text)
{
  if (printable(text) != text)
    throw std::invalid_argument(fmt::format("'{}' has control characters, which gnuplot cannot take", printable(text)));
  // gnuplot 5.4 takes two quotes at the beginning for an empty string.
  std::string quoted = text.rfind('\'', 0) == 0 ? "' " : "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + '\'';
}

void Gnuplot::run(const std::string& terminal, const std::filesystem::path& output, const std::string& script) const
{
  const auto file = folder_.path() / "figure.gp", log = folder_.path() / "log.txt";
  std::ofstream(file) << fmt::format("set terminal {} noenhanced font 'sans-serif,13'\nset output {}\n{}", terminal,
                                     gnuplotString(std::filesystem::absolute(output).string()), script);
  if (runCommand({{"gnuplot", file}, {}}, log) != 0)
    throw std::runtime_error(fmt::format("gnuplot: {}", contentOf(log)));
}

std::string Gnuplot::draw(const std::string& script)
{
  const auto svg = folder_.path() / "figure.svg";
  run("svg size 900,420 dynamic", svg, script);
  const std::string drawn = contentOf(svg);
  const std::string element = drawn.substr(std::min(drawn.find("<svg"), drawn.size()));  // no XML declaration
  return withPrefixedIds(element, fmt::format("figure{}_", ++figures_));
}

void Gnuplot::drawInto(const std::filesystem::path& path, const std::string& script)
{
  const std::string ending = path.extension().string();
  if (ending != ".svg" && ending != ".png")
    throw std::invalid_argument(fmt::format("{}: a figure is .svg or .png", path.string()));
  OutputFile file(path);
  run(ending == ".svg" ? "svg size 900,900 dynamic" : "pngcairo size 1350,1350 fontscale 1.5 linewidth 1.5",
      file.temporary(), script);
  file.commit();
}
}  // namespace scanloom
