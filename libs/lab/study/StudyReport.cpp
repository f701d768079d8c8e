#include "lab/study/StudyReport.h"

#include "lab/study/internal/StudyFigures.h"
#include "lab/study/internal/StudyQuantities.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace scanloom
{
namespace
{
constexpr const char* kStyle =
    "body{font:16px/1.5 sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222;background:#fff}"
    "table{border-collapse:collapse;font-size:.85rem}th,td{border:1px solid #bbb;padding:.2rem .5rem;text-align:right}"
    "th{background:#eee}td:first-child,td:nth-child(2),td:nth-child(3){text-align:left}"
    "figure{margin:1rem "
    "0}svg{max-width:100%;height:auto}pre{background:#f4f4f4;padding:.6rem;white-space:pre-wrap;overflow-wrap:anywhere}"
    ".wide{overflow-x:auto}";

std::string escaped(const std::string& text)
{
  std::string html;
  for (const char c : text)
    html += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return html;
}

std::string valueText(const CellSummary& summary)
{
  if (summary.medianIsLost()) return "lost";
  const auto median = summary.median();
  return median ? fmt::format("{:.3g}", *median) : "-";
}

std::string cellText(const CellSummary& summary) { return summary.empty() ? "" : valueText(summary); }

std::string alternativeOverDistance(const std::vector<StudyCell>& cells)
{
  std::vector<std::string> parts;
  for (const StudyCell& cell : cells)
  {
    const auto medians = medianOverDistance(cell);
    if (!medians.empty())
      parts.push_back(fmt::format("{}, {}: {:.3g} m after {:.0f} m", cell.lidars, cell.group, medians.back().error,
                                  medians.back().distance));
  }
  return fmt::format("Median error over the distance: {}.", fmt::join(parts, "; "));
}

std::string figureElement(const std::string& svg, const std::string& alternative_text, const std::string& caption)
{
  return fmt::format("<figure><div role=\"img\" aria-label=\"{}\">{}</div><figcaption>{}</figcaption></figure>\n",
                     escaped(alternative_text), svg, escaped(caption));
}

/** One group per stage of slam, for the N and settings of the first cell only. */
std::vector<Bar> stageBars(const std::vector<StudyCell>& cells)
{
  std::vector<Bar> bars;
  for (const std::string& stage : stagesOf(cells))
    for (const StudyCell& cell : cells)
      if (cell.group == cells.front().group && stage.rfind("output.", 0) != 0)
        bars.push_back({stage, cell.lidars, summaryOf(cell, millisecondsOf(stage))});
  return bars;
}

/** The content of a figure as text, for a screen reader. */
std::string alternative(const std::vector<Bar>& bars, const std::string& what)
{
  std::vector<std::string> parts;
  for (const Bar& bar : bars) parts.push_back(fmt::format("{}, {}: {}", bar.series, bar.group, valueText(bar.summary)));
  return fmt::format("Medians of {}: {}.", what, fmt::join(parts, "; "));
}

std::string barsFigure(const std::vector<Bar>& bars, const std::string& axis, const std::string& caption,
                       const Draw& draw)
{
  return figureElement(draw(barsScript(bars, axis)), alternative(bars, axis), caption);
}

bool noneHas(const Quantity& quantity, const std::vector<StudyCell>& cells)
{
  return std::all_of(cells.begin(), cells.end(),
                     [&](const StudyCell& cell) { return summaryOf(cell, quantity).empty(); });
}

/** What the runs were compared with, a sentence. */
std::string referencesOf(const std::vector<StudyCell>& cells)
{
  std::set<std::string> references;
  for (const StudyCell& cell : cells)
    for (const RunRecord* record : cell.records)
      if (!record->reference.empty()) references.insert(record->reference);
  if (!references.empty()) return fmt::format("Compared with {}.", fmt::join(references, "; "));
  if (!noneHas(drift(), cells)) return "";  // results of a version that did not tell
  return "There is no reference, so no drift: a run is judged by the health of its poses, and is lost if it ends LOST.";
}

std::string figuresOf(const std::string& stand, const std::vector<StudyCell>& cells, const Draw& draw)
{
  std::string html = fmt::format("<h2>{}</h2>\n<p>{}</p>\n", escaped(stand), escaped(referencesOf(cells)));
  for (const Quantity& quantity : drawnQuantities())
  {
    if (noneHas(quantity, cells)) continue;
    const std::string lost = "; crosses and hatched bars are lost runs and medians (beyond 10 m or 5 % of the path)";
    html += barsFigure(barsOf(cells, quantity), quantity.name,
                       fmt::format("{}, {}: medians as bars, a dot per run{}.", stand, quantity.name,
                                   quantity.lost == LostRuns::CountedApart ? lost : ""),
                       draw);
  }
  for (const auto& lines : noneHas(drift(), cells) ? std::vector<std::vector<StudyCell>>{} : byLines(cells))
    html += figureElement(
        draw(driftOverDistanceScript(lines)), alternativeOverDistance(lines),
        fmt::format("{}, drift over distance at the IMU's rate: medians of the runs that were not lost.", stand));
  const std::vector<Bar> stages = stageBars(cells);
  if (stages.empty()) return html + "<p>No run came to its end: see the log.txt of each.</p>\n";
  return html + barsFigure(stages, "mean [ms]",
                           fmt::format("{}, {}: milliseconds per stage; medians as bars, a dot per run.", stand,
                                       cells.front().group),
                           draw);
}

std::string table(const std::vector<StudyCell>& cells, const std::vector<Quantity>& columns)
{
  std::string html = "<div class=\"wide\"><table><tr><th>stand</th><th>lidars</th><th>group</th>";
  for (const Quantity& column : columns) html += fmt::format("<th>{}</th>", escaped(column.name));
  html += "<th>runs</th><th>lost</th><th>failed</th></tr>\n";
  for (const StudyCell& cell : cells)
  {
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td>", escaped(cell.stand), escaped(cell.lidars),
                        escaped(cell.group));
    for (const Quantity& column : columns) html += fmt::format("<td>{}</td>", cellText(summaryOf(cell, column)));
    const auto failed = std::count_if(cell.records.begin(), cell.records.end(),
                                      [](const RunRecord* record) { return !record->finished(); });
    const auto lost =
        std::count_if(cell.records.begin(), cell.records.end(), [](const RunRecord* record) { return record->lost(); });
    html += fmt::format("<td>{}</td><td>{}</td><td>{}</td></tr>\n", cell.records.size(), lost, failed);
  }
  return html + "</table></div>\n";
}

/** Of each recording once: its runs have the same. */
std::string marksOf(const std::vector<RunRecord>& records)
{
  std::set<std::string> described;
  std::string rows;
  for (const RunRecord& record : records)
  {
    if (record.marks.empty() || !described.insert(record.run.stand).second) continue;
    for (const RecordedMark& mark : record.marks)
      rows += fmt::format("<tr><td>{}</td><td>{:.1f}</td><td>{}</td></tr>\n", escaped(record.run.stand), mark.after,
                          escaped(mark.text));
  }
  if (rows.empty()) return "";
  return "<h2>Marked events</h2>\n<p>By a person while the recording was made; seconds after its first scan.</p>\n"
         "<table><tr><th>stand</th><th>time [s]</th><th>event</th></tr>\n" +
         rows + "</table>\n";
}

std::string failures(const std::vector<RunRecord>& records)
{
  std::string items;
  for (const RunRecord& record : records)
    if (!record.finished())
      items += fmt::format("<li>{}: {}</li>\n", escaped(record.run.label()), escaped(record.error));
  return items.empty() ? "" : "<h2>Failed runs</h2>\n<ul>\n" + items + "</ul>\n";
}

std::vector<std::vector<StudyCell>> byStand(const std::vector<StudyCell>& cells)
{
  std::vector<std::vector<StudyCell>> stands;
  for (const StudyCell& cell : cells)
  {
    const auto found = std::find_if(stands.begin(), stands.end(),
                                    [&](const auto& stand) { return stand.front().stand == cell.stand; });
    if (found == stands.end())
      stands.push_back({cell});
    else
      found->push_back(cell);
  }
  return stands;
}
}  // namespace

std::string htmlReport(const Study& study, const std::string& configuration, const Draw& draw)
{
  const std::vector<StudyCell> cells = cellsOf(study.records);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>scanloom experiment</title><style>{}</style></head><body>\n"
      "<h1>scanloom experiment</h1>\n<p>{} runs, version {}, on {}. Every run: <a "
      "href=\"results.csv\">results.csv</a>, "
      "<a href=\"results.json\">results.json</a>. To repeat it:</p>\n<pre>{}</pre>\n",
      kStyle, study.records.size(), study.records.empty() ? "" : escaped(study.records.front().version),
      escaped(study.machine), escaped(study.command));
  for (const auto& stand : byStand(cells)) html += figuresOf(stand.front().stand, stand, draw);
  html += "<h2>Errors and health, medians</h2>\n" + table(cells, errorQuantities());
  html += "<h2>Milliseconds per stage, real-time factor, memory; medians</h2>\n" + table(cells, costQuantities(cells));
  html += marksOf(study.records) + failures(study.records);
  return html + fmt::format("<h2>Configuration</h2>\n<pre>{}</pre>\n</body></html>\n", escaped(configuration));
}
}  // namespace scanloom
