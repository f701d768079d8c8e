#include "input/rig/silentLidars.h"

#include <fmt/format.h>

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr std::size_t kSendersNamed = 3;

/** Counts of packets that are of no use, and of what was done with the blocks of the others. */
std::string whatBecameOf(const LidarAccount& lidar)
{
  std::string counts;
  const auto add = [&](const char* what, std::uint64_t count)
  {
    if (count > 0) counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, what);
  };
  const LidarCounters& c = lidar.counters;
  add("packets of another format (malformed)", c.malformed_packets);
  add("packets with a wrong checksum", c.bad_crc_packets);
  add("packets of another sensor (foreign)", c.foreign_packets);
  add("packets that contradict each other (doubtful)", c.doubtful_packets);
  add("packets of another sender", lidar.of_other_senders);
  add("blocks before the start", c.before_start);
  add("blocks left out for their clock (quarantined)", c.quarantined);
  add("blocks late", c.late);
  add("blocks invalid", c.invalid);
  return counts.empty() ? "no packet of it came: does it send to this computer (udp_dest), does its configuration name "
                          "the right port, does a firewall let it through?"
                        : counts;
}
}  // namespace

std::vector<std::string> silentLidars(const RigAccount& account)
{
  std::vector<std::string> lines;
  for (const LidarAccount& lidar : account.lidars)
    if (lidar.counters.emitted == 0)
      lines.push_back(fmt::format("lidar '{}' is in no scan: {}", lidar.name, whatBecameOf(lidar)));
  if (lines.empty()) return lines;

  std::vector<std::pair<Origin, std::uint64_t>> senders(account.unmatched.begin(), account.unmatched.end());
  std::stable_sort(senders.begin(), senders.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  senders.resize(std::min(senders.size(), kSendersNamed));
  for (const auto& [origin, datagrams] : senders)
    lines.push_back(fmt::format(
        "{} datagrams {} are of no lidar: another port, serial number, product id or format than its metadata say "
        "('scanloom info CAPTURE --metadata FILE' tells more)",
        datagrams, origin.text()));
  return lines;
}
}  // namespace scanloom
