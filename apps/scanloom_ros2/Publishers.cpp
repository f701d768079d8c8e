#include "Publishers.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

namespace scanloom
{
namespace
{
/** Nothing for topics that are none of ROS. */
std::optional<Ros2Publication> publicationOf(const dds_builtintopic_endpoint_t& endpoint)
{
  if (!endpoint.topic_name || !endpoint.type_name) return std::nullopt;
  const std::optional<Ros2Topic> topic = rosTopicOf(endpoint.topic_name, endpoint.type_name);
  if (!topic) return std::nullopt;
  dds_reliability_kind_t reliability = DDS_RELIABILITY_BEST_EFFORT;
  dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE;
  dds_duration_t blocking = 0;
  dds_qget_reliability(endpoint.qos, &reliability, &blocking);
  dds_qget_durability(endpoint.qos, &durability);
  return Ros2Publication{*topic, 1, reliability == DDS_RELIABILITY_RELIABLE, durability != DDS_DURABILITY_VOLATILE};
}
}  // namespace

void Publishers::follow(const dds_builtintopic_endpoint_t& endpoint, const dds_sample_info_t& info,
                        const dds_guid_t& own)
{
  constexpr std::size_t kMostPublishers = 10'000;  // an unknown sender may announce without end
  Guid key;
  std::copy(std::begin(endpoint.key.v), std::end(endpoint.key.v), key.begin());
  if (info.instance_state != DDS_ALIVE_INSTANCE_STATE)
  {
    publishers_.erase(key);
    return;
  }
  const bool is_own = std::memcmp(own.v, endpoint.participant_key.v, sizeof own.v) == 0;
  if (is_own || publishers_.size() >= kMostPublishers) return;
  if (std::optional<Ros2Publication> publication = publicationOf(endpoint)) publishers_[key] = std::move(*publication);
}

std::vector<Ros2Publication> Publishers::publications() const
{
  std::map<std::pair<std::string, std::string>, Ros2Publication> by_topic;
  for (const auto& [key, publisher] : publishers_)
  {
    const auto [known, is_first] = by_topic.try_emplace({publisher.topic.name, publisher.topic.type}, publisher);
    if (is_first) continue;
    ++known->second.publishers;
    known->second.reliable &= publisher.reliable;
    known->second.kept_for_latecomers &= publisher.kept_for_latecomers;
  }
  std::vector<Ros2Publication> publications;
  for (auto& [topic, publication] : by_topic) publications.push_back(std::move(publication));
  return publications;
}
}  // namespace scanloom
