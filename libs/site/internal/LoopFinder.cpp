#include "site/internal/LoopFinder.h"

#include "base/core/Angle.h"
#include "estimation/ndt/FittedConstants.h"
#include "site/internal/LoopSearch.h"

#include <algorithm>
#include <set>
#include <utility>

namespace scanloom
{
namespace
{
constexpr double kWayBetweenPasses = 40;  // m: nearer along the way, keyframes share a local map
constexpr double kBeside = 8;             // m: passes that are farther apart see little in common
constexpr double kFarthestReach = 30;     // m: what is less certain is searched after others have been found
constexpr std::size_t kEnough = 3;        // other parts in which a keyframe is found: more tell nothing new
constexpr double kOneAnother = 20;        // m of way: loops that are nearer to each other must agree

struct Guess
{
  Rigid site_T_body;
  double sigma = 0;  // m
};

bool isSurer(const Guess& a, const Guess& b) { return a.sigma < b.sigma; }

/** Searches one keyframe after the other: what is found for one tells where the next ones are. */
class Sweep
{
 public:
  Sweep(SiteState state, const SiteLayout& layout, const LoopSearch& search)
    : state_(std::move(state)), layout_(layout), search_(search)
  {
  }

  /** Searches the keyframe about those of the part. */
  void searchAll(std::size_t to, std::size_t about)
  {
    if (isFoundInEnough(to, about)) return;
    const SitePart& part = layout_.parts()[about];
    const std::vector<Guess> known = guessesOf(to, about);
    const std::optional<Guess> rough = surest(known, to, part.begin);
    if (!rough) return;
    for (const std::size_t from : passesBy(to, rough->site_T_body, part, kBeside + 3 * rough->sigma))
    {
      const Guess guess = *surest(known, to, from);
      const double reach = 0.3 + 3 * guess.sigma;
      if (distance(from, guess.site_T_body) > kBeside + reach || reach > kFarthestReach || isFound(from, to)) continue;
      forget(from, to);
      state_.loops.push_back(search_.search(state_.keyframes, from, to, guess.site_T_body, reach));
    }
  }

  std::vector<Loop> loops() && { return std::move(state_.loops); }

 private:
  const Rigid& poseOf(std::size_t keyframe) const { return state_.keyframes[keyframe].site_T_body; }

  double distance(std::size_t keyframe, const Rigid& pose) const
  {
    return (poseOf(keyframe).translation - pose.translation).norm();
  }

  /** By loops with the other part, and by known keyframes of the own one. */
  std::vector<Guess> guessesOf(std::size_t to, std::size_t other) const
  {
    std::vector<Guess> guesses;
    const std::size_t own = layout_.partOf(to);
    const auto addIf = [&](std::size_t here, std::size_t there, const Rigid& there_T_here)
    {
      if (layout_.partOf(here) != own || layout_.partOf(there) != other) return;
      guesses.push_back(
          {poseOf(there) * there_T_here * poseOf(here).inverse() * poseOf(to), kLoopSigma + layout_.drift(here, to)});
    };
    for (const Loop& loop : state_.loops)
    {
      if (loop.decision != LoopDecision::Accepted) continue;
      addIf(loop.to, loop.from, loop.from_T_to);
      addIf(loop.from, loop.to, loop.from_T_to.inverse());
    }
    for (const KnownKeyframe& known : state_.known)
      if (layout_.partOf(known.keyframe) == own && own != other)
        guesses.push_back({poseOf(to), known.sigma + layout_.drift(known.keyframe, to)});
    if (guesses.empty()) return {};
    return {*std::min_element(guesses.begin(), guesses.end(), &isSurer)};
  }

  /** Of those, or by the odometry from `from` on. */
  std::optional<Guess> surest(std::vector<Guess> guesses, std::size_t to, std::size_t from) const
  {
    if (layout_.partOf(to) == layout_.partOf(from)) guesses.push_back({poseOf(to), layout_.drift(from, to)});
    if (guesses.empty()) return std::nullopt;
    return *std::min_element(guesses.begin(), guesses.end(), &isSurer);
  }

  /** The nearest keyframe, earlier than `to`, of each pass of the part by the place. */
  std::vector<std::size_t> passesBy(std::size_t to, const Rigid& place, const SitePart& part, double within) const
  {
    const auto isNear = [&](std::size_t from)
    {
      const bool shares_map = layout_.partOf(from) == layout_.partOf(to) && layout_.way(from, to) < kWayBetweenPasses;
      return from < to && !shares_map && distance(from, place) < within;
    };
    std::vector<std::size_t> nearest;
    bool is_pass = false;
    for (std::size_t from = part.begin; from < part.end; ++from)
    {
      const bool was_pass = std::exchange(is_pass, isNear(from));
      if (!is_pass) continue;
      if (!was_pass)
        nearest.push_back(from);
      else if (distance(from, place) < distance(nearest.back(), place))
        nearest.back() = from;
    }
    return nearest;
  }

  /** In parts other than its own and this one: time grows with the number of drives, and not with its square. */
  bool isFoundInEnough(std::size_t to, std::size_t about) const
  {
    std::set<std::size_t> parts;
    for (const Loop& loop : state_.loops)
      if (loop.to == to && loop.decision == LoopDecision::Accepted) parts.insert(layout_.partOf(loop.from));
    parts.erase(layout_.partOf(to));
    parts.erase(about);
    return layout_.partOf(to) != about && parts.size() >= kEnough;
  }

  bool isFound(std::size_t from, std::size_t to) const
  {
    const auto isOfPass = [&](const Loop& loop)
    {
      return loop.to == to && loop.decision == LoopDecision::Accepted &&
             layout_.partOf(loop.from) == layout_.partOf(from) && layout_.way(loop.from, from) < kBeside;
    };
    return std::any_of(state_.loops.begin(), state_.loops.end(), isOfPass);
  }

  /** What was searched when less was known. */
  void forget(std::size_t from, std::size_t to)
  {
    const auto isSame = [&](const Loop& loop) { return loop.from == from && loop.to == to; };
    state_.loops.erase(std::remove_if(state_.loops.begin(), state_.loops.end(), isSame), state_.loops.end());
  }

  SiteState state_;
  const SiteLayout& layout_;
  const LoopSearch& search_;
};

bool wasFound(const Loop& loop)
{
  return loop.decision == LoopDecision::Accepted || loop.decision == LoopDecision::Alone;
}
}  // namespace

std::vector<Loop> withLoopsFound(const SiteState& state, const SiteLayout& layout, const LoopSearch& search,
                                 std::size_t of, std::size_t about,
                                 const std::function<void(std::size_t keyframe)>& searching)
{
  Sweep sweep(state, layout, search);
  const SitePart& part = layout.parts()[of];
  for (std::size_t to = part.begin; to < part.end; ++to)
  {
    searching(to);
    sweep.searchAll(to, about);
  }
  return std::move(sweep).loops();
}

std::vector<Loop> withoutLoneOnes(std::vector<Loop> loops, const std::vector<SiteKeyframe>& keyframes,
                                  const SiteLayout& layout)
{
  const auto areBeside = [&](std::size_t a, std::size_t b)
  { return layout.partOf(a) == layout.partOf(b) && layout.way(a, b) < kOneAnother; };
  const auto between = [&](std::size_t a, std::size_t b)
  { return keyframes[a].site_T_body.inverse() * keyframes[b].site_T_body; };
  const auto agree = [&](const Loop& a, const Loop& b)
  {
    if (!areBeside(a.to, b.to) || !areBeside(a.from, b.from)) return false;
    const Vector6d apart = boxMinus(between(b.from, a.from) * a.from_T_to * between(a.to, b.to), b.from_T_to);
    return apart.head<3>().norm() < fitted::kSamePlace && apart.tail<3>().norm() < fitted::kSamePlaceDeg * kDegree;
  };
  std::vector<Loop> decided = loops;
  for (std::size_t i = 0; i < loops.size(); ++i)
  {
    if (!wasFound(loops[i])) continue;
    bool is_confirmed = false;
    for (std::size_t k = 0; k < loops.size() && !is_confirmed; ++k)
      is_confirmed = k != i && wasFound(loops[k]) && agree(loops[k], loops[i]);
    decided[i].decision = is_confirmed ? LoopDecision::Accepted : LoopDecision::Alone;
  }
  return decided;
}
}  // namespace scanloom
