/** `scanloom report`: the results of an experiment as one HTML page. */
#include "Arguments.h"
#include "Verb.h"
#include "base/core/OutputFile.h"
#include "lab/study/ContentHash.h"
#include "lab/study/Gnuplot.h"
#include "lab/study/StudyReport.h"

#include <iostream>
#include <memory>

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

int run(const ReportArguments& arguments)
{
  const auto path = arguments.folder / kReport;
  refuseExisting({path}, arguments.overwrite);
  const Study study = readStudy(arguments.folder);
  const auto configuration = arguments.folder / "configuration.ini";
  Gnuplot gnuplot(arguments.folder);
  const std::string html = htmlReport(study, std::filesystem::exists(configuration) ? contentOf(configuration) : "",
                                      [&](const std::string& script) { return gnuplot.draw(script); });
  writeAtomically(path, [&](std::ostream& file) { file << html; });
  std::cout << path.string() << '\n';
  return kDone;
}

std::function<int()> addReportOptions(CLI::App& app)
{
  auto arguments = std::make_shared<ReportArguments>();
  addOption(app, "DIR", arguments->folder, "folder of an experiment, as --out-dir of 'experiment' wrote it")
      .required()
      .existingFolder();
  addOverwrite(app, arguments->overwrite);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb reportVerb() { return {"report", "the results of an experiment as one HTML page", {}, &addReportOptions}; }
}  // namespace scanloom
