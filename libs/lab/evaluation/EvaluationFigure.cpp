#include "lab/evaluation/EvaluationFigure.h"

#include <fmt/format.h>

#include <iterator>

namespace scanloom
{
namespace
{
/** t [s], x y z of the estimate, x y z of the reference [m]. From the first position on: coordinates may be national.
 */
std::string positionRows(const Evaluation& evaluation)
{
  std::string rows;
  const PositionPair& first = evaluation.pairs.front();
  for (const PositionPair& pair : evaluation.pairs)
  {
    const Eigen::Vector3d estimate = evaluation.drift.alignment.reference_T_map * pair.map_p - first.reference_p;
    const Eigen::Vector3d reference = pair.reference_p - first.reference_p;
    fmt::format_to(std::back_inserter(rows), "{:.3f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f}\n",
                   seconds(pair.stamp - first.stamp), estimate.x(), estimate.y(), estimate.z(), reference.x(),
                   reference.y(), reference.z());
  }
  return rows;
}

std::string errorRows(const Drift& drift)
{
  std::string rows;
  for (const ErrorAtDistance& at : drift.over_distance)
    fmt::format_to(std::back_inserter(rows), "{:.3f} {:.5f}\n", at.distance, at.error);
  return rows;
}

constexpr const char* kPanels = R"(
set grid lc rgb "#cccccc"
set xtics nomirror
set ytics nomirror
set multiplot
set size 1,0.62
set origin 0,0.38
set size ratio -1
set key outside top center horizontal
set xlabel "x [m]"
set ylabel "y [m]"
plot $positions using 5:6 with lines lw 4 lc rgb "#bbbbbb" title "reference", \
     $positions using 2:3 with lines lw 1.5 lc rgb "#0072B2" title "estimate", \
     $positions using 5:6 every ::0::0 with points pt 7 ps 0.8 lc rgb "#000000" title "start"
set size noratio
set size 0.5,0.38
set origin 0,0
set xlabel "time [s]"
set ylabel "z [m]"
plot $positions using 1:7 with lines lw 4 lc rgb "#bbbbbb" notitle, \
     $positions using 1:4 with lines lw 1.5 lc rgb "#0072B2" notitle
set origin 0.5,0
set xlabel "distance [m]"
set ylabel "error [m]"
set yrange [0:*]
plot $errors using 1:2 with lines lw 1.5 lc rgb "#D55E00" notitle
unset multiplot
)";
}  // namespace

std::string figureScript(const Evaluation& evaluation)
{
  return fmt::format("$positions << EOD\n{}EOD\n$errors << EOD\n{}EOD\n{}", positionRows(evaluation),
                     errorRows(evaluation.drift), kPanels);
}
}  // namespace scanloom
