#include "slam/Recovery.h"

#include <algorithm>

namespace scanloom
{
void Recovery::changeBias(const ImuBias& bias)
{
  if (last_seen_) last_seen_->bias = bias;
}

std::optional<FoundBody> Recovery::search(const NdtMap& local_map, const std::vector<View>& views, const LostBody& lost,
                                          const ScanRegistrationOptions& options, StageTimes& times)
{
  constexpr Duration kInterval = 1s;
  constexpr double kSpeed = 1.5, kFarthest = 10;  // m/s, m
  constexpr double kAsGood = 0.75;                // of the last trusted registration's score
  if (!last_seen_ || (last_search_ && lost.stamp - last_search_->stamp < kInterval)) return std::nullopt;
  const bool all_headings = last_search_ && !last_search_->all_headings;
  last_search_ = {lost.stamp, all_headings};

  const SearchArea area{{lost.local_R_body, last_seen_->local_T_body.translation},
                        std::min(kFarthest, kSpeed * seconds(lost.since_trusted)),
                        all_headings ? 8 : 1};
  const auto found =
      times.measure("recovery", [&] { return relocalise(local_map, views, area, options.fine_cells, options.fine); });
  if (!found || found->score > kAsGood * last_seen_->score) return std::nullopt;  // scores are negative
  last_search_.reset();
  return FoundBody{*found, covarianceWithin(area, *found)};
}
}  // namespace scanloom
