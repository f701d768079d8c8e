#include "input/bags/internal/FrameTree.h"

#include <algorithm>
#include <set>

namespace scanloom
{
void FrameTree::add(const FrameTransform& t)
{
  if (t.parent.empty() || t.child.empty() || t.parent == t.child) return;
  links_[t.child] = {t.parent, t.parent_T_child};
}

/** The frame itself, its parent, and so on; of a frame that hangs from itself the frame alone. */
std::vector<FrameTree::Ancestor> FrameTree::ancestorsOf(const std::string& frame) const
{
  std::vector<Ancestor> ancestors{{frame, Rigid::identity()}};
  for (auto link = links_.find(frame); link != links_.end() && ancestors.size() <= links_.size();
       link = links_.find(link->second.parent))
    ancestors.push_back({link->second.parent, link->second.parent_T_child * ancestors.back().ancestor_T_frame});
  const bool in_circle = ancestors.size() > links_.size();  // more steps than links
  if (in_circle && links_.count(ancestors.back().frame) > 0) ancestors.resize(1);
  return ancestors;
}

std::optional<Rigid> FrameTree::transform(const std::string& to, const std::string& from) const
{
  const std::vector<Ancestor> of_to = ancestorsOf(to);
  for (const Ancestor& common : ancestorsOf(from))
  {
    const auto found =
        std::find_if(of_to.begin(), of_to.end(), [&](const Ancestor& a) { return a.frame == common.frame; });
    if (found != of_to.end()) return found->ancestor_T_frame.inverse() * common.ancestor_T_frame;
  }
  return std::nullopt;
}

std::vector<std::string> FrameTree::inCircles() const
{
  std::map<std::string, bool> ends;  // by frame: whether its parents do; each is followed once
  for (const auto& [child, link] : links_)
  {
    std::vector<std::string> way;
    std::string frame = child;
    for (; links_.count(frame) > 0 && ends.emplace(frame, false).second; frame = links_.at(frame).parent)
      way.push_back(frame);
    const bool way_ends = links_.count(frame) == 0 || ends.at(frame);
    for (const std::string& passed : way) ends[passed] = way_ends;
  }
  std::vector<std::string> circling;
  for (const auto& [frame, frame_ends] : ends)
    if (!frame_ends) circling.push_back(frame);
  return circling;
}

bool FrameTree::has(const std::string& frame) const
{
  const std::vector<std::string> all = frames();
  return std::binary_search(all.begin(), all.end(), frame);
}

std::string FrameTree::rootOf(const std::string& frame) const { return ancestorsOf(frame).back().frame; }

std::vector<std::string> FrameTree::frames() const
{
  std::set<std::string> names;
  for (const auto& [child, link] : links_)
  {
    names.insert(child);
    names.insert(link.parent);
  }
  return {names.begin(), names.end()};
}
}  // namespace scanloom
