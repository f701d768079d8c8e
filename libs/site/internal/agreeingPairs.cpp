#include "site/internal/agreeingPairs.h"

#include "base/positions/Alignment.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace scanloom
{
namespace
{
constexpr std::size_t kLeast = 5;                  // pairs: a heading that a wrong one does not decide
constexpr double kLeastApart = 10;                 // m, of two pairs by which the frames are aligned
constexpr std::size_t kTried = 40;                 // pairs, evenly among all, of which each two are tried
constexpr double kSlack = 1, kSlackPerWay = 0.01;  // m, 1

std::vector<std::size_t> evenly(std::size_t all, std::size_t most)
{
  std::vector<std::size_t> some;
  const std::size_t count = std::min(all, most);
  for (std::size_t i = 0; i < count; ++i) some.push_back(i * all / count);
  return some;
}

std::vector<std::size_t> explained(const std::vector<PositionPair>& pairs, const PositionPair& a, const PositionPair& b,
                                   double sigma)
{
  const Rigid reference_T_map = align({a, b}, AlignmentKind::Yaw).reference_T_map;
  std::vector<std::size_t> agreeing;
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    const double off = (reference_T_map * pairs[i].map_p - pairs[i].reference_p).norm();
    const double way = std::min((pairs[i].map_p - a.map_p).norm(), (pairs[i].map_p - b.map_p).norm());
    if (off < 3 * sigma + kSlack + kSlackPerWay * way) agreeing.push_back(i);
  }
  return agreeing;
}
}  // namespace

std::vector<std::size_t> agreeingPairs(const std::vector<PositionPair>& pairs, double sigma)
{
  std::vector<std::size_t> best;
  const std::vector<std::size_t> tried = evenly(pairs.size(), kTried);
  for (const std::size_t i : tried)
    for (const std::size_t k : tried)
    {
      if (k <= i || (pairs[i].map_p - pairs[k].map_p).norm() < kLeastApart) continue;
      std::vector<std::size_t> agreeing = explained(pairs, pairs[i], pairs[k], sigma);
      if (agreeing.size() > best.size()) best = std::move(agreeing);
    }
  if (best.size() < kLeast || 2 * best.size() < pairs.size()) return {};
  return best;
}
}  // namespace scanloom
