#include "cyclone.h"

#include "base/core/Text.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>

namespace scanloom
{
dds_entity_t checked(dds_entity_t result, const std::string& what)
{
  if (result < 0) throw std::runtime_error(fmt::format("ROS 2 (DDS): {}: {}", what, dds_strretcode(result)));
  return result;
}

Qos newQos() { return {dds_create_qos(), &dds_delete_qos}; }

Qos qosOf(bool reliable, bool for_latecomers, int messages)
{
  Qos qos = newQos();
  dds_qset_reliability(qos.get(), reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_durability(qos.get(), for_latecomers ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, messages);
  if (for_latecomers)
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, messages, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

void logToPerson(void*, const dds_log_data_t* line)
{
  constexpr int kShown = 5;              // any sender of the network can cause a line for each of its packets
  constexpr std::size_t kLongest = 200;  // characters
  static std::atomic<int> number{0};
  const int n = ++number;
  if (n > kShown) return;
  const std::string_view text(line->message, std::min(line->size, kLongest));
  fmt::print(stderr, "warning: ROS 2 (DDS): {}{}\n", printable(std::string(trimmed(text))),
             n == kShown ? " (no more of these are shown)" : "");
}
}  // namespace scanloom
