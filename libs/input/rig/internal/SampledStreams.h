#pragma once
#include "input/packets/IpAddress.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
/** The datagrams of one sender to one port, or of a topic of a bag, by some of them. */
struct SampledStream
{
  using Packet = std::vector<std::uint8_t>;

  IpAddress source;
  std::uint16_t port = 0;  // destination
  std::string topic;       // of a bag, instead of source and port; empty in a capture
  std::uint64_t datagrams = 0;
  std::vector<Packet> samples;  // the first ones, and then ever fewer
};

/**
 * What the first ten seconds of captures hold, or their first 2000 datagrams; by port, source, topic. Throws what
 * MergedCaptures throws, and std::runtime_error with the damages if these leave no datagram.
 */
std::vector<SampledStream> streamsOf(const std::vector<std::filesystem::path>& captures);
}  // namespace scanloom
