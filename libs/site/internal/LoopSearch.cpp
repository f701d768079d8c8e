#include "site/internal/LoopSearch.h"

#include "base/core/Angle.h"
#include "estimation/graph/PosePriorFactor.h"

#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kSeenTogether = 6;  // m of way: as far as the keyframes reach that are searched with one
constexpr std::size_t kEvery = 3;    // keyframes, 12 m: drives that cross are near each other on so much way
constexpr double kSight = 14;        // m of way: keyframes farther off see little of what is searched

Matrix6d withCommonErrors(Matrix6d covariance)
{
  covariance.diagonal().head<3>().array() += kLoopSigma * kLoopSigma;
  covariance.diagonal().tail<3>().array() += std::pow(kLoopSigmaDeg * kDegree, 2);
  return covariance;
}

LoopDecision decisionOf(PlaceOutcome outcome)
{
  if (outcome == PlaceOutcome::LookAlike) return LoopDecision::LookAlike;
  return outcome == PlaceOutcome::NotInMap ? LoopDecision::NotFound : LoopDecision::Accepted;
}
}  // namespace

LoopSearch::LoopSearch(const std::vector<SiteDrive>& drives, const SiteLayout& layout, const SlamSettings& settings)
  : drives_(drives), layout_(layout), settings_(settings), rig_(drives)
{
}

Keyframe LoopSearch::inSite(const std::vector<SiteKeyframe>& keyframes, std::size_t i) const
{
  const std::size_t drive = layout_.driveOf(i);
  Keyframe keyframe = rig_.withIds(drive, drives_[drive].keyframe(layout_.indexOf(i)));
  keyframe.map_T_body = keyframes[i].site_T_body;
  return keyframe;
}

std::shared_ptr<const PriorMap> LoopSearch::mapOf(const std::vector<SiteKeyframe>& keyframes,
                                                  const std::vector<std::size_t>& chosen) const
{
  std::vector<Keyframe> of_map;
  for (const std::size_t i : chosen) of_map.push_back(inSite(keyframes, i));
  return std::make_shared<const PriorMap>(of_map, rig_.lidars(), settings_);
}

Loop LoopSearch::search(const std::vector<SiteKeyframe>& keyframes, std::size_t from, std::size_t to,
                        const Rigid& guess, double reach) const
{
  const std::vector<std::size_t> seen = layout_.within(kSeenTogether, to);
  const Rigid& place_of_to = keyframes[to].site_T_body;
  const Rigid guess_of_first = guess * place_of_to.inverse() * keyframes[seen.front()].site_T_body;
  PlaceSearch search(mapOf(keyframes, layout_.within(kSight + reach, from)), settings_, rig_.lidars(),
                     PlaceGuess{guess_of_first, reach});
  for (std::size_t i = 0; i + 1 < seen.size(); ++i) search.see(inSite(keyframes, seen[i]));
  const SearchedPlace searched = search.add(inSite(keyframes, seen.back()));

  Loop loop{from, to, reach, searched.agreement, decisionOf(searched.outcome)};
  if (!searched.place) return loop;
  const Rigid found = searched.place->map_T_drive * place_of_to;
  loop.from_T_to = keyframes[from].site_T_body.inverse() * found;
  const Rigid newest_T_to = searched.place->map_T_body.inverse() * found;
  loop.covariance = withCommonErrors(movedTo(newest_T_to, searched.place->of_registration));
  return loop;
}

std::optional<FoundKeyframe> LoopSearch::findAnywhere(const std::vector<SiteKeyframe>& keyframes,
                                                      const std::vector<std::size_t>& in,
                                                      const std::vector<std::size_t>& of) const
{
  PlaceSearch search(mapOf(keyframes, in), settings_, rig_.lidars());
  bool waits_for_second = false;
  for (std::size_t i = 0; i < of.size(); ++i)
  {
    const Keyframe keyframe = inSite(keyframes, of[i]);
    if (!waits_for_second && (i + 1) % kEvery != 0 && i + 1 < of.size())
    {
      search.see(keyframe);
      continue;
    }
    const SearchedPlace found = search.add(keyframe);
    if (found.outcome == PlaceOutcome::Found) return FoundKeyframe{of[i], found.place->map_T_body};
    waits_for_second = found.outcome == PlaceOutcome::Unconfirmed;
  }
  return std::nullopt;
}
}  // namespace scanloom
