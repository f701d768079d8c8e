#include "base/core/Finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace scanloom
{
namespace
{
constexpr std::size_t kWidth = 100;  // characters
constexpr std::size_t kVerdictWidth = 9, kMeasureWidth = 15;
constexpr std::size_t kIndent = 2 + kVerdictWidth + 1 + kMeasureWidth + 1;

/** Breaks lines at spaces and indents all but the first. */
std::string wrapped(const std::string& text, std::size_t indent)
{
  std::string result;
  std::size_t column = indent;
  std::istringstream words(text);
  for (std::string word; words >> word;)
  {
    const bool begins = result.empty();
    if (!begins && column + 1 + word.size() > kWidth)
    {
      result += '\n' + std::string(indent, ' ');
      column = indent;
    }
    else if (!begins)
    {
      result += ' ';
      ++column;
    }
    result += word;
    column += word.size();
  }
  return result;
}
}  // namespace

std::string toString(Verdict verdict)
{
  switch (verdict)
  {
    case Verdict::Ok:
      return "ok";
    case Verdict::NotMeasured:
      return "-";
    case Verdict::Warning:
      return "warning";
    case Verdict::NotFit:
      return "NOT FIT";
  }
  return "";
}

Verdict grade(double value, double warning, double not_fit)
{
  return value > not_fit ? Verdict::NotFit : value > warning ? Verdict::Warning : Verdict::Ok;
}

Verdict worstOf(const Findings& findings)
{
  Verdict worst = Verdict::Ok;
  for (const Finding& finding : findings) worst = std::max(worst, finding.verdict);
  return worst;
}

std::string summaryOf(const Findings& findings)
{
  const auto count = [&findings](Verdict verdict)
  {
    return std::count_if(findings.begin(), findings.end(),
                         [verdict](const Finding& f) { return f.verdict == verdict; });
  };
  const auto bad = count(Verdict::NotFit), warnings = count(Verdict::Warning);
  const std::string fit =
      bad > 0 ? fmt::format("NOT FIT for SLAM for {} reason{}", bad, bad == 1 ? "" : "s") : "fit for SLAM";
  return fit + (warnings > 0 ? fmt::format(", {} warning{}", warnings, warnings == 1 ? "" : "s") : "");
}

std::string toText(const Findings& findings)
{
  std::string text, about;
  for (const Finding& finding : findings)
  {
    if (finding.about != about) text += (text.empty() ? "" : "\n") + finding.about + '\n';
    about = finding.about;
    text += fmt::format("  {:<{}} {:<{}} {}\n", toString(finding.verdict), kVerdictWidth, finding.measure,
                        kMeasureWidth, wrapped(finding.says, kIndent));
    if (!finding.mend.empty())
      text += fmt::format("{}-> {}\n", std::string(kIndent, ' '), wrapped(finding.mend, kIndent + 3));
  }
  return text;
}
}  // namespace scanloom
