/** Searches what a few keyframes of a drive have seen in the map of a few others. */
#pragma once
#include "site/Site.h"
#include "site/internal/RigOfDrives.h"
#include "site/internal/SiteLayout.h"

#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
/** Registrations of the same structures from other sides err alike: this is added to their covariance. */
constexpr double kLoopSigma = 0.01;     // m
constexpr double kLoopSigmaDeg = 0.02;  // deg

struct FoundKeyframe
{
  std::size_t keyframe;
  Rigid site_T_body;
};

class LoopSearch
{
 public:
  /** Drives and layout must outlive it. */
  LoopSearch(const std::vector<SiteDrive>&, const SiteLayout&, const SlamSettings&);

  /** Keyframe `to`, seen with its neighbours, in the map around `from`, within `reach` (m) of the guess. */
  Loop search(const std::vector<SiteKeyframe>&, std::size_t from, std::size_t to, const Rigid& guess,
              double reach) const;

  /**
   * Keyframes `of`, every third with the two before it, anywhere in the map of those `in`: the first that is found, and
   * confirmed by the next one.
   */
  std::optional<FoundKeyframe> findAnywhere(const std::vector<SiteKeyframe>&, const std::vector<std::size_t>& in,
                                            const std::vector<std::size_t>& of) const;

 private:
  Keyframe inSite(const std::vector<SiteKeyframe>&, std::size_t) const;
  std::shared_ptr<const PriorMap> mapOf(const std::vector<SiteKeyframe>&, const std::vector<std::size_t>&) const;

  const std::vector<SiteDrive>& drives_;
  const SiteLayout& layout_;
  SlamSettings settings_;
  RigOfDrives rig_;
};
}  // namespace scanloom
