#include "input/rig/internal/SampledStreams.h"

#include "input/bags/BagPackets.h"
#include "input/packets/MergedCaptures.h"
#include "input/rig/PacketRouter.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
constexpr Duration kLookedAt = 10s;             // every lidar of a rig sends within it
constexpr std::uint64_t kLeastLookedAt = 2000;  // datagrams: times of reception may be in a wrong unit
constexpr std::size_t kMostStreams = 1000;      // a network may have more senders than memory should be spent on
constexpr std::uint64_t kFirst = 64;            // datagrams of a stream that are kept, all of them

/** One in eight of the first 1024 after them: a second sensor behind the same sender shows within a turn. */
bool isKept(std::uint64_t number) { return number < kFirst || (number < 1024 && number % 8 == 0); }
}  // namespace

std::vector<SampledStream> streamsOf(const std::vector<std::filesystem::path>& captures)
{
  MergedCaptures datagrams(datagramsOf(captures));
  std::map<Origin, SampledStream> streams;
  std::optional<Timestamp> first;
  std::uint64_t looked_at = 0;
  for (Datagram datagram; datagrams.next(datagram);)
  {
    if (!first) first = datagram.received;
    if (datagram.received - *first > kLookedAt && looked_at >= kLeastLookedAt) break;
    ++looked_at;
    const Origin origin = originOf(datagram);
    if (streams.size() >= kMostStreams && streams.count(origin) == 0) continue;
    SampledStream& stream =
        streams.try_emplace(origin, SampledStream{origin.source, origin.destination_port, origin.topic, 0, {}})
            .first->second;
    if (isKept(stream.datagrams++)) stream.samples.push_back(datagram.payload);
  }
  if (const CaptureCounters counters = datagrams.counters(); !first && !counters.damages.empty())
    throw std::runtime_error(fmt::format("{}", fmt::join(counters.damages, "\n")));
  std::vector<SampledStream> result;
  for (auto& [origin, stream] : streams) result.push_back(std::move(stream));
  return result;
}
}  // namespace scanloom
