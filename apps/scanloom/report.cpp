/** `scanloom report`: the results of an experiment as one page. */
#include "Arguments.h"
#include "Command.h"
#include "StudyReport.h"
#include "Verb.h"
#include "config/AtomicFile.h"

#include <fmt/format.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <regex>
#include <stdexcept>

namespace scanloom
{
namespace
{
struct ReportArguments
{
  std::filesystem::path folder;
  bool overwrite = false;
};

constexpr const char* kReport = "report.html";

std::string contentOf(const std::filesystem::path& path)
{
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/** All figures share one page: what is defined in one must not be found from another. */
std::string withOwnNames(const std::string& svg, const std::string& prefix)
{
  static const std::regex definition("(\\bid ?= ?['\"])"), reference("((?:href ?= ?['\"]|url\\()#)");
  return std::regex_replace(std::regex_replace(svg, definition, "$1" + prefix), reference, "$1" + prefix);
}

/** Where gnuplot reads its script and leaves its picture; gone with the report. */
class Scratch
{
 public:
  explicit Scratch(const std::filesystem::path& parent)
  {
    std::string name = (parent / "report_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error(fmt::format("cannot write into {}", parent.string()));
    folder_ = name;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch()
  {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::string draw(const std::string& script)
  {
    const auto file = folder_ / "figure.gp", log = folder_ / "log.txt", svg = folder_ / "figure.svg";
    std::ofstream(file) << fmt::format(
        "set terminal svg size 900,420 dynamic noenhanced font 'sans-serif,13'\nset output '{}'\n{}", svg.string(),
        script);
    if (runCommand({{"gnuplot", file}, {}}, log) != 0)
      throw std::runtime_error(fmt::format("gnuplot: {}", contentOf(log)));
    const std::string drawn = contentOf(svg);
    const std::string element = drawn.substr(std::min(drawn.find("<svg"), drawn.size()));  // no XML declaration
    return withOwnNames(element, fmt::format("figure{}_", ++figures_));
  }

 private:
  std::filesystem::path folder_;
  int figures_ = 0;
};

int run(const ReportArguments& arguments)
{
  const auto path = arguments.folder / kReport;
  refuseExisting({path}, arguments.overwrite);
  const Study study = readStudy(arguments.folder);
  Scratch scratch(arguments.folder);
  const std::string html = htmlReport(study, contentOf(arguments.folder / "configuration.ini"),
                                      [&](const std::string& script) { return scratch.draw(script); });
  writeAtomically(path, [&](std::ostream& file) { file << html; });
  std::cout << path.string() << '\n';
  return kDone;
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<ReportArguments>();
  app.add_option("DIR", arguments->folder, "the folder of an experiment")->required()->check(CLI::ExistingDirectory);
  addOverwrite(app, arguments->overwrite);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb reportVerb() { return {"report", "the results of an experiment as one HTML file", {}, &addOptions}; }
}  // namespace scanloom
