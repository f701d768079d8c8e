#include "run/run/internal/ExtrinsicsDetails.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace scanloom
{
namespace
{
constexpr float kReach = 20;  // m: farther away points are sparse

using Cell = std::pair<int, int>;

Cell cellOf(const Eigen::Vector3f& p, float edge)
{
  return {static_cast<int>(std::floor(p.x() / edge)), static_cast<int>(std::floor(p.y() / edge))};
}

/** Lowest tenth of the reference's points in cells of 2 m: height of the ground. */
class Ground
{
 public:
  explicit Ground(const Points3& points)
  {
    std::map<Cell, std::vector<float>> heights;
    for (const Eigen::Vector3f& p : points)
      if (p.head<2>().norm() < kReach) heights[cellOf(p, kCell)].push_back(p.z());
    for (auto& [cell, z] : heights)
    {
      const auto tenth = z.begin() + static_cast<std::ptrdiff_t>(z.size() / 10);
      std::nth_element(z.begin(), tenth, z.end());
      height_[cell] = *tenth;
    }
  }

  std::optional<float> at(const Eigen::Vector3f& p) const
  {
    const auto found = height_.find(cellOf(p, kCell));
    return found == height_.end() ? std::nullopt : std::optional<float>(found->second);
  }

 private:
  static constexpr float kCell = 2;
  std::map<Cell, float> height_;
};

constexpr float kStemCell = 0.25F;

using Counts = std::map<Cell, std::size_t>;

Counts sliceOf(const Points3& points, const Ground& ground)
{
  Counts counts;
  for (const Eigen::Vector3f& p : points)
  {
    const std::optional<float> z = ground.at(p);
    if (z && p.z() > *z + kSliceBottom && p.z() < *z + kSliceTop) ++counts[cellOf(p, kStemCell)];
  }
  return counts;
}

std::size_t within(const Counts& counts, const Cell& centre, int cells)
{
  std::size_t sum = 0;
  for (int x = -cells; x <= cells; ++x)
    for (int y = -cells; y <= cells; ++y)
      if (const auto found = counts.find({centre.first + x, centre.second + y}); found != counts.end())
        sum += found->second;
  return sum;
}

Eigen::Vector3f planeThrough(const Points3& points, const GroundStrip& strip)
{
  Eigen::Matrix3f squares = 1e-3F * Eigen::Matrix3f::Identity();
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& p : points)
  {
    if (!strip.contains(p)) continue;
    const Eigen::Vector3f row(p.x(), p.y(), 1);
    squares += row * row.transpose();
    sum += row * p.z();
  }
  return squares.llt().solve(sum);
}

Points3 nearGround(const Points3& points, const Ground& ground)
{
  constexpr float kThick = 0.4F;
  Points3 near;
  for (const Eigen::Vector3f& p : points)
    if (const std::optional<float> z = ground.at(p); z && std::abs(p.z() - *z) < kThick) near.push_back(p);
  return near;
}

constexpr std::size_t kPieces = 20;  // of a strip

std::array<std::size_t, kPieces> countAlong(const GroundStrip& strip, const Points3& points)
{
  std::array<std::size_t, kPieces> counts{};
  for (const Eigen::Vector3f& p : points)
  {
    if (!strip.contains(p)) continue;
    const auto piece = static_cast<std::size_t>((p[strip.axis] - strip.from) / kStripLength * kPieces);
    ++counts[std::min(piece, kPieces - 1)];
  }
  return counts;
}

/** Points in the pieces that both lidars see; many in one piece count as a few. */
std::size_t seenByBoth(const GroundStrip& strip, const Points3& a, const Points3& b)
{
  constexpr std::size_t kEnough = 10;
  const auto of_a = countAlong(strip, a), of_b = countAlong(strip, b);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < kPieces; ++i) seen += std::min({of_a[i], of_b[i], kEnough});
  return seen;
}
}  // namespace

std::optional<SeenStem> bestStem(const Points3& reference, const Points3& lidar)
{
  constexpr std::size_t kFewestOnStem = 10;
  const Ground ground(reference);
  const Counts a = sliceOf(reference, ground), b = sliceOf(lidar, ground);
  std::optional<SeenStem> best;
  double best_score = 0;
  for (const auto& [cell, count] : a)
  {
    const std::size_t seen = std::min(within(a, cell, 1), within(b, cell, 1));
    const auto around = static_cast<double>(within(a, cell, 4) + within(b, cell, 4));
    const auto here = static_cast<double>(within(a, cell, 1) + within(b, cell, 1));
    const double score = static_cast<double>(seen) * (here / around) * (here / around);
    if (seen < kFewestOnStem || score <= best_score) continue;
    best_score = score;
    const Eigen::Vector3f centre(kStemCell * (static_cast<float>(cell.first) + 0.5F),
                                 kStemCell * (static_cast<float>(cell.second) + 0.5F), 0);
    best = SeenStem{centre.head<2>(), ground.at(centre).value_or(0), seen};
  }
  return best;
}

bool GroundStrip::contains(const Eigen::Vector3f& p) const
{
  const float along = p[axis] - from, aside = p[1 - axis] - across;
  return along >= 0 && along < kStripLength && std::abs(aside) < kStripWidth / 2;
}

float GroundStrip::height(const Eigen::Vector3f& p) const
{
  return p.z() - plane.dot(Eigen::Vector3f(p.x(), p.y(), 1));
}

std::optional<GroundStrip> bestGroundStrip(const Points3& reference, const Points3& lidar)
{
  constexpr std::size_t kFewestOnGround = 30;
  const Ground ground(reference);
  const Points3 a = nearGround(reference, ground), b = nearGround(lidar, ground);
  std::optional<GroundStrip> best;
  for (const int axis : {0, 1})
    for (int from = -14; from <= 4; from += 2)
      for (int across = -10; across <= 10; ++across)
      {
        GroundStrip strip;
        strip.axis = axis, strip.from = static_cast<float>(from), strip.across = static_cast<float>(across);
        strip.seen = seenByBoth(strip, a, b);
        if (strip.seen >= kFewestOnGround && (!best || strip.seen > best->seen)) best = strip;
      }
  if (best) best->plane = planeThrough(a, *best);
  return best;
}
}  // namespace scanloom
