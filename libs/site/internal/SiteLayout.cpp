#include "site/internal/SiteLayout.h"

namespace scanloom
{
SiteLayout::SiteLayout(const std::vector<SiteDrive>& drives)
{
  for (std::size_t d = 0; d < drives.size(); ++d)
  {
    first_of_drive_.push_back(size());
    drifts_.emplace_back(drives[d].keyframes());
    bool begins = true;
    for (const DriveKeyframe& keyframe : drives[d].keyframes())
    {
      if (begins || keyframe.begins_a_part) parts_.push_back({d, size(), size()});
      begins = false;
      part_of_.push_back(parts_.size() - 1);
      ++parts_.back().end;
    }
  }
}

double SiteLayout::way(std::size_t a, std::size_t b) const { return drifts_[driveOf(a)].way(indexOf(a), indexOf(b)); }

double SiteLayout::drift(std::size_t a, std::size_t b) const
{
  return drifts_[driveOf(a)].between(indexOf(a), indexOf(b));
}

std::vector<std::size_t> SiteLayout::within(double longest, std::size_t of) const
{
  std::vector<std::size_t> near;
  const SitePart& part = parts_[part_of_[of]];
  for (std::size_t i = part.begin; i < part.end; ++i)
    if (way(i, of) <= longest) near.push_back(i);
  return near;
}
}  // namespace scanloom
