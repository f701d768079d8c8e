#include "input/bags/internal/MergedBags.h"

#include <algorithm>
#include <numeric>

namespace scanloom
{
MergedBags::MergedBags(std::vector<std::unique_ptr<BagReader>> bags)
{
  for (auto& bag : bags) parts_.push_back({std::move(bag), {}, {}, false});
  for (Part& part : parts_) addTopics(part);
  for (Part& part : parts_) readOn(part);
}

void MergedBags::addTopics(Part& part)
{
  const std::vector<BagTopic>& topics = part.bag->topics();
  for (std::size_t i = part.topics.size(); i < topics.size(); ++i)
  {
    const auto [place, is_new] = places_.try_emplace({topics[i].name, topics[i].type}, topics_.size());
    if (is_new) topics_.push_back(topics[i]);
    part.topics.push_back(place->second);
  }
}

void MergedBags::readOn(Part& part)
{
  part.has_front = part.bag->next(part.front);
  addTopics(part);
}

bool MergedBags::next(BagMessage& message)
{
  if (taken_) readOn(parts_[*taken_]);
  taken_.reset();

  const auto earlier = [](const Part& a, const Part& b)
  { return a.has_front && (!b.has_front || a.front.received < b.front.received); };
  const auto oldest = std::min_element(parts_.begin(), parts_.end(), earlier);
  if (oldest == parts_.end() || !oldest->has_front) return false;

  taken_ = static_cast<std::size_t>(oldest - parts_.begin());
  message = oldest->front;
  message.topic = oldest->topics[message.topic];
  return true;
}

std::vector<std::string> MergedBags::takeWarnings()
{
  std::vector<std::string> warnings;
  for (Part& part : parts_)
    for (std::string& warning : part.bag->takeWarnings()) warnings.push_back(std::move(warning));
  return warnings;
}

double MergedBags::progress() const
{
  const double sum = std::accumulate(parts_.begin(), parts_.end(), 0.0,
                                     [](double s, const Part& part) { return s + part.bag->progress(); });
  return sum / static_cast<double>(parts_.size());
}
}  // namespace scanloom
