#include "study/Gnuplot.h"

#include "study/Command.h"
#include "study/ContentHash.h"

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

Gnuplot::Gnuplot(const std::filesystem::path& parent)
{
  std::string name = (parent / "report_XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error(fmt::format("cannot write into {}", parent.string()));
  folder_ = name;
}

Gnuplot::~Gnuplot()
{
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string Gnuplot::draw(const std::string& script)
{
  const auto file = folder_ / "figure.gp", log = folder_ / "log.txt", svg = folder_ / "figure.svg";
  std::ofstream(file) << fmt::format(
      "set terminal svg size 900,420 dynamic noenhanced font 'sans-serif,13'\nset output '{}'\n{}", svg.string(),
      script);
  if (runCommand({{"gnuplot", file}, {}}, log) != 0)
    throw std::runtime_error(fmt::format("gnuplot: {}", contentOf(log)));
  const std::string drawn = contentOf(svg);
  const std::string element = drawn.substr(std::min(drawn.find("<svg"), drawn.size()));  // no XML declaration
  return withPrefixedIds(element, fmt::format("figure{}_", ++figures_));
}
}  // namespace scanloom
