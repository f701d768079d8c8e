#include "run/run/ExtrinsicsPicture.h"

#include "base/formats/Canvas.h"
#include "run/run/internal/ExtrinsicsDetails.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace scanloom
{
namespace
{
constexpr int kMargin = 50, kTitle = 60, kStemSide = 480, kGroundWidth = 900, kGap = 60;
constexpr double kStemWindow = 1.6;    // m
constexpr double kGroundHeight = 0.6;  // m, shown above and below the plane together

const Color kPaper{0.98F, 0.98F, 0.97F}, kInk{0.15F, 0.16F, 0.18F}, kGrid{0.80F, 0.80F, 0.80F};
const Color kReference{0.10F, 0.35F, 0.75F}, kLidar{0.90F, 0.45F, 0.05F};

const ExtrinsicsScene kNothing;

/** A rectangle of the picture, and what part of a plane it shows. */
struct Panel
{
  int left, top, width, height;  // pixels
  Eigen::Vector2d from, to;      // m, lower left and upper right corner

  bool shows(const Eigen::Vector2d& p) const
  {
    return (p.array() >= from.array()).all() && (p.array() <= to.array()).all();
  }
  Eigen::Vector2d pixel(const Eigen::Vector2d& p) const
  {
    const Eigen::Vector2d share = (p - from).cwiseQuotient(to - from);
    return {left + width * share.x(), top + height * (1 - share.y())};
  }
};

/** Where a point is in a panel; none: the panel does not show it. */
using Placed = std::function<std::optional<Eigen::Vector2d>(const Eigen::Vector3f&)>;

void paintFrame(Canvas& canvas, const Panel& panel, const Eigen::Vector2d& step, const std::string& caption)
{
  canvas.fillRectangle(panel.left, panel.top, panel.width, panel.height, Color(1, 1, 1));
  for (double x = panel.from.x(); x <= panel.to.x() + 1e-6; x += step.x())
  {
    canvas.line(panel.pixel({x, panel.from.y()}), panel.pixel({x, panel.to.y()}), 1, kGrid);
    const std::string label = fmt::format("{:.1f}", x);
    canvas.text(static_cast<int>(panel.pixel({x, 0}).x()) - Canvas::textWidth(label, Canvas::Font::Small) / 2,
                panel.top + panel.height + 4, label, Canvas::Font::Small, kInk);
  }
  for (double y = panel.from.y(); y <= panel.to.y() + 1e-6; y += step.y())
  {
    canvas.line(panel.pixel({panel.from.x(), y}), panel.pixel({panel.to.x(), y}), 1, kGrid);
    const std::string label = fmt::format("{:.1f}", y);
    canvas.text(panel.left - 6 - Canvas::textWidth(label, Canvas::Font::Small),
                static_cast<int>(panel.pixel({0, y}).y()) - 6, label, Canvas::Font::Small, kInk);
  }
  canvas.text(panel.left, panel.top - 22, caption, Canvas::Font::Large, kInk);
}

/** The points of both by turns, so that neither hides the other. */
void paintPoints(Canvas& canvas, const Panel& panel, const Points3& reference, const Points3& lidar,
                 const Placed& placed)
{
  constexpr double kRadius = 2;
  for (std::size_t i = 0; i < std::max(reference.size(), lidar.size()); ++i)
    for (const bool first : {true, false})
    {
      const Points3& points = first ? reference : lidar;
      const std::optional<Eigen::Vector2d> at = i < points.size() ? placed(points[i]) : std::nullopt;
      if (at && panel.shows(*at)) canvas.disc(panel.pixel(*at), kRadius, first ? kReference : kLidar);
    }
}

void paintStem(Canvas& canvas, int top, const std::string& when, const ExtrinsicsScene& scene, const Points3& lidar,
               const std::optional<SeenStem>& stem)
{
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(kStemWindow / 2);
  Panel panel{kMargin, top, kStemSide, kStemSide, -half, half};
  paintFrame(canvas, panel, {0.4, 0.4}, fmt::format("{}: from above, 1.0 to 1.6 m above the ground (m)", when));
  if (!stem)
    return canvas.text(panel.left + 20, panel.top + 20, "nothing upright that both lidars see", Canvas::Font::Large,
                       kInk);
  const Placed placed = [&](const Eigen::Vector3f& p) -> std::optional<Eigen::Vector2d>
  {
    const float height = p.z() - stem->ground;
    if (height < kSliceBottom || height > kSliceTop) return std::nullopt;
    return (p.head<2>() - stem->centre).cast<double>();
  };
  paintPoints(canvas, panel, scene.reference, lidar, placed);
}

void paintGround(Canvas& canvas, int top, const std::string& when, const ExtrinsicsScene& scene, const Points3& lidar,
                 const std::optional<GroundStrip>& strip)
{
  Panel panel{kMargin + kStemSide + kGap,       top, kGroundWidth, kStemSide, {0, -kGroundHeight / 2},
              {kStripLength, kGroundHeight / 2}};
  paintFrame(canvas, panel, {1, 0.1},
             fmt::format("{}: the ground from the side, along {}, height {} times as large (m)", when,
                         !strip || strip->axis == 0 ? "x" : "y",
                         std::lround(kStemSide / kGroundHeight / (kGroundWidth / kStripLength))));
  if (!strip)
    return canvas.text(panel.left + 20, panel.top + 20, "no ground that both lidars see", Canvas::Font::Large, kInk);
  const Placed placed = [&](const Eigen::Vector3f& p) -> std::optional<Eigen::Vector2d>
  {
    if (!strip->contains(p)) return std::nullopt;
    return Eigen::Vector2d(p[strip->axis] - strip->from, strip->height(p));
  };
  paintPoints(canvas, panel, scene.reference, lidar, placed);
}

/** The scene in which both see most, and what they see there. */
template <typename Detail>
std::pair<const ExtrinsicsScene*, std::optional<Detail>> bestOf(const std::vector<ExtrinsicsScene>& scenes,
                                                                std::optional<Detail> (*detailOf)(const Points3&,
                                                                                                  const Points3&))
{
  std::pair<const ExtrinsicsScene*, std::optional<Detail>> best{&kNothing, std::nullopt};
  for (const ExtrinsicsScene& scene : scenes)
  {
    const std::optional<Detail> detail = detailOf(scene.reference, scene.after);
    if (detail && (!best.second || detail->seen > best.second->seen)) best = {&scene, detail};
  }
  return best;
}
}  // namespace

void drawExtrinsics(const std::filesystem::path& file, const std::vector<ExtrinsicsScene>& scenes,
                    const ExtrinsicsPictureText& text)
{
  constexpr int kRow = kStemSide + 70;
  Canvas canvas(2 * kMargin + kStemSide + kGap + kGroundWidth, kTitle + 2 * kRow + 10, kPaper);
  canvas.text(kMargin, 10, fmt::format("'{}'", text.reference), Canvas::Font::Large, kReference);
  canvas.text(kMargin + 20 + Canvas::textWidth(text.reference + "''", Canvas::Font::Large), 10,
              fmt::format("'{}'", text.lidar), Canvas::Font::Large, kLidar);
  const auto [stem_scene, stem] = bestOf<SeenStem>(scenes, &bestStem);
  const auto [ground_scene, strip] = bestOf<GroundStrip>(scenes, &bestGroundStrip);
  const int first = kTitle, second = kTitle + kRow;
  paintStem(canvas, first, "before", *stem_scene, stem_scene->before, stem);
  paintGround(canvas, first, "before", *ground_scene, ground_scene->before, strip);
  paintStem(canvas, second, "after", *stem_scene, stem_scene->after, stem);
  paintGround(canvas, second, "after", *ground_scene, ground_scene->after, strip);
  canvas.savePng(file);
}
}  // namespace scanloom
