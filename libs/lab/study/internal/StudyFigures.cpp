#include "lab/study/internal/StudyFigures.h"

#include "base/core/Statistics.h"
#include "lab/study/Gnuplot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

namespace scanloom
{
namespace
{
constexpr double kBar = 0.8;        // width of a bar; bars are 1 apart
constexpr double kLostRoom = 1.12;  // lost runs are drawn this much above the largest value
constexpr std::size_t kBins = 20;
constexpr std::size_t kLevelLabels = 6;  // with more groups the labels are rotated

/** Okabe and Ito 2008: also for colour-blind readers. */
constexpr std::array kColours{"#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00"};

std::string colour(std::size_t i) { return kColours[i % kColours.size()]; }

template <typename Owner>
std::vector<std::string> distinct(const std::vector<Owner>& owners, std::string Owner::*name)
{
  std::vector<std::string> names;
  for (const Owner& owner : owners)
    if (std::find(names.begin(), names.end(), owner.*name) == names.end()) names.push_back(owner.*name);
  return names;
}

std::size_t indexOf(const std::vector<std::string>& names, const std::string& name)
{
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

struct BarBlocks
{
  std::string medians, lost_medians, dots, lost_dots;
};

/** The dots of a bar, side by side in the order of the runs. */
std::string spread(double x, const std::vector<double>& values)
{
  std::string rows;
  const double step = kBar / static_cast<double>(values.size() + 1);
  for (std::size_t i = 0; i < values.size(); ++i)
    rows += fmt::format("{:.4f} {:.6g}\n", x - kBar / 2 + step * static_cast<double>(i + 1), values[i]);
  return rows;
}

std::string block(const std::string& name, const std::string& rows)
{
  return fmt::format("${} << EOD\n{}EOD\n", name, rows.empty() ? "NaN NaN\n" : rows);
}

double topOf(const std::vector<Bar>& bars)
{
  double largest = 0;
  for (const Bar& bar : bars)
    for (const double value : bar.summary.values) largest = std::max(largest, value);
  return largest > 0 ? kLostRoom * largest : 1;
}

/** A vertex holds the error up to the next one: the last vertex before `begin` counts, too. */
double largestWithin(double begin, double end, const std::vector<ErrorAtDistance>& vertices)
{
  const auto before = [](double distance, const ErrorAtDistance& vertex) { return distance < vertex.distance; };
  auto first = std::upper_bound(vertices.begin(), vertices.end(), begin, before);
  if (first != vertices.begin()) --first;
  double largest = 0;
  for (auto vertex = first; vertex != vertices.end() && vertex->distance <= end; ++vertex)
    largest = std::max(largest, vertex->error);
  return largest;
}

/** "N = 5, cell_size = 1" gives the names "N, cell_size", written once below the axis, and the values "5, 1". */
struct GroupLabel
{
  std::string names, values;
};

GroupLabel labelOf(const std::string& group)
{
  constexpr std::string_view kIs = " = ", kNext = ", ";
  std::vector<std::string> names, values;
  for (std::size_t begin = 0; begin < group.size();)
  {
    const std::size_t end = std::min(group.find(kNext, begin), group.size());
    const std::string part = group.substr(begin, end - begin);
    const std::size_t is = part.find(kIs);
    if (is == std::string::npos) return {"", group};
    names.push_back(part.substr(0, is));
    values.push_back(part.substr(is + kIs.size()));
    begin = end + kNext.size();
  }
  if (names.size() < 2) return {"", group};
  return {fmt::format("{}", fmt::join(names, kNext)), fmt::format("{}", fmt::join(values, kNext))};
}

/** A label of a tick, which gnuplot takes for a format. */
std::string tickLabel(const std::string& text)
{
  std::string format;
  for (const char c : text) format += c == '%' ? std::string("%%") : std::string(1, c);
  return gnuplotString(format);
}

std::string ticks(const std::vector<std::string>& groups, std::size_t bars)
{
  std::vector<std::string> labels;
  for (std::size_t g = 0; g < groups.size(); ++g)
    labels.push_back(fmt::format("{} {:.2f}", tickLabel(labelOf(groups[g]).values),
                                 static_cast<double>(g * (bars + 1)) + 0.5 * static_cast<double>(bars - 1)));
  const std::string names = groups.empty() ? "" : labelOf(groups.front()).names;
  return fmt::format("set xtics ({}) scale 0 rotate by {}\nset xlabel {}\n", fmt::join(labels, ", "),
                     groups.size() > kLevelLabels ? -25 : 0, gnuplotString(names));
}
}  // namespace

std::vector<Bar> barsOf(const std::vector<StudyCell>& cells, const Quantity& quantity)
{
  std::vector<Bar> bars;
  for (const StudyCell& cell : cells) bars.push_back({cell.group, cell.lidars, summaryOf(cell, quantity)});
  return bars;
}

std::string barsScript(const std::vector<Bar>& bars, const std::string& axis)
{
  const auto groups = distinct(bars, &Bar::group), series = distinct(bars, &Bar::series);
  const double top = topOf(bars);
  std::vector<BarBlocks> blocks(series.size());
  bool any_lost = false;
  for (const auto& [group, name, summary] : bars)
  {
    const std::size_t s = indexOf(series, name), g = indexOf(groups, group);
    const auto x = static_cast<double>(g * (series.size() + 1) + s);
    BarBlocks& b = blocks[s];
    if (const auto median = summary.median()) b.medians += fmt::format("{} {:.6g}\n", x, *median);
    if (summary.medianIsLost()) b.lost_medians += fmt::format("{} {:.6g}\n", x, top);
    b.dots += spread(x, summary.values);
    b.lost_dots += spread(x, std::vector<double>(summary.lost, top));
    any_lost |= summary.lost > 0;
  }

  std::string script, plots;
  for (std::size_t s = 0; s < series.size(); ++s)
  {
    const BarBlocks& b = blocks[s];
    script += block(fmt::format("median{}", s), b.medians) + block(fmt::format("hatched{}", s), b.lost_medians) +
              block(fmt::format("dots{}", s), b.dots) + block(fmt::format("lost{}", s), b.lost_dots);
    plots += fmt::format(
        "{0}$median{1} using 1:2 with boxes lc rgb \"{2}\" fillstyle solid 0.45 title {3}, "
        "$hatched{1} using 1:2 with boxes lc rgb \"{2}\" fillstyle pattern 4 notitle, "
        "$dots{1} using 1:2 with points pt 7 ps 0.4 lc rgb \"black\" notitle, "
        "$lost{1} using 1:2 with points pt 2 ps 0.7 lc rgb \"black\" notitle",
        s > 0 ? ", " : "", s, colour(s), gnuplotString(series[s]));
  }
  const double width = static_cast<double>(groups.size() * (series.size() + 1));
  script += fmt::format(
      "set boxwidth {}\nset xrange [-1:{}]\nset yrange [0:{:.6g}]\n{}set ylabel {}\n"
      "set key outside top center horizontal\nset grid ytics\n",
      kBar, width - 1, top * 1.05, ticks(groups, series.size()), gnuplotString(axis));
  if (any_lost) script += fmt::format("set label \"lost\" at graph 1.005, first {:.6g}\n", top);
  return script + "plot " + plots + "\n";
}

std::vector<ErrorAtDistance> medianOverDistance(const StudyCell& cell)
{
  double longest = 0;
  std::vector<const RunFigures*> runs;
  for (const RunRecord* record : cell.records)
    if (record->figures && !record->lost())
    {
      runs.push_back(&*record->figures);
      longest = std::max(longest, record->figures->path);
    }

  std::vector<ErrorAtDistance> medians;
  for (std::size_t bin = 1; bin <= kBins; ++bin)
  {
    const double begin = longest * static_cast<double>(bin - 1) / kBins;
    const double end = longest * static_cast<double>(bin) / kBins;
    std::vector<double> errors;
    for (const RunFigures* run : runs)
      if (run->path > begin) errors.push_back(largestWithin(begin, end, run->over_distance));
    if (!errors.empty()) medians.push_back({end, median(std::move(errors))});
  }
  return medians;
}

std::vector<std::vector<StudyCell>> byLines(const std::vector<StudyCell>& cells)
{
  constexpr std::size_t kMostLines = 12, kDashes = 5;
  if (cells.size() <= kMostLines && distinct(cells, &StudyCell::group).size() <= kDashes) return {cells};
  std::vector<std::vector<StudyCell>> figures;
  for (const std::string& lidars : distinct(cells, &StudyCell::lidars))
  {
    figures.emplace_back();
    std::copy_if(cells.begin(), cells.end(), std::back_inserter(figures.back()),
                 [&](const StudyCell& cell) { return cell.lidars == lidars; });
  }
  return figures;
}

std::string driftOverDistanceScript(const std::vector<StudyCell>& cells)
{
  const auto groups = distinct(cells, &StudyCell::group), series = distinct(cells, &StudyCell::lidars);
  std::string script, plots;
  double farthest = 0;
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    std::string rows;
    for (const auto& [distance, error] : medianOverDistance(cells[c]))
    {
      rows += fmt::format("{:.6g} {:.6g}\n", distance, error);
      farthest = std::max(farthest, distance);
    }
    script += block(fmt::format("cell{}", c), rows);
    const std::size_t group = indexOf(groups, cells[c].group);
    const std::size_t hue = series.size() > 1 ? indexOf(series, cells[c].lidars) : group;
    const std::size_t dashes = series.size() > 1 ? group : group / kColours.size();
    plots +=
        fmt::format("{}$cell{} using 1:2 with lines lw 1.5 dt {} lc rgb \"{}\" title {}", c > 0 ? ", " : "", c,
                    dashes + 1, colour(hue), gnuplotString(cells[c].lidars + ", " + labelOf(cells[c].group).values));
  }
  // If all runs were lost, gnuplot has no data to choose a range from.
  script += farthest > 0 ? fmt::format("set xrange [0:{:.6g}]\nset yrange [0:*]\n", farthest)
                         : "set xrange [0:1]\nset yrange [0:1]\n";
  const std::string names = cells.empty() ? "" : labelOf(cells.front().group).names;
  if (!names.empty()) script += fmt::format("set key title {}\n", gnuplotString("lidars, " + names));
  return script +
         "set xlabel \"distance [m]\"\nset ylabel \"error [m], median\"\nset grid\nset key outside right\nplot " +
         plots + "\n";
}
}  // namespace scanloom
