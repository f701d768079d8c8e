#include "input/rig/internal/streamMessages.h"

#include "base/core/ConfigError.h"
#include "input/lidar/LidarModels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace scanloom
{
namespace
{
std::string whence(const SampledStream& stream)
{
  return stream.topic.empty() ? fmt::format("from {} to port {}", stream.source.text(), stream.port)
                              : "on topic " + stream.topic;
}

std::string whither(const SampledStream& stream)
{
  return stream.topic.empty() ? fmt::format("to port {}", stream.port) : "on topic " + stream.topic;
}

/** Why a candidate is no lidar of these streams. */
std::string whyNot(const MetadataCandidate& candidate, const std::vector<SampledStream>& streams)
{
  if (!candidate.decoder) return candidate.fault;
  const LidarDescription& lidar = candidate.decoder->description();
  const std::string described =
      fmt::format("{}: a {}{}{}", candidate.file.string(), lidar.model, lidar.serial.empty() ? "" : " ", lidar.serial);
  for (const SampledStream& stream : streams)
    for (const SampledStream::Packet& packet : stream.samples)
    {
      const PacketKind kind = candidate.decoder->kind(packet);
      if (kind == PacketKind::Foreign)
      {
        const auto serial = candidate.decoder->header(packet).serial;
        return serial ? fmt::format("{}, but packets {} are of serial number {}", described, whither(stream), *serial)
                      : fmt::format("{}, but packets {} are of another model", described, whither(stream));
      }
      if (kind == PacketKind::BadCrc)
        return fmt::format("{}, but packets {} have a wrong checksum", described, whither(stream));
    }
  return fmt::format("{}: no packet has the format, size or pace of its packets", described);
}

std::string describe(const SampledStream& stream)
{
  std::set<std::size_t> sizes;
  for (const SampledStream::Packet& packet : stream.samples) sizes.insert(packet.size());
  const std::string bytes =
      sizes.size() == 1 ? fmt::format("{}", *sizes.begin()) : fmt::format("{} to {}", *sizes.begin(), *sizes.rbegin());
  return fmt::format("{} datagrams of {} bytes {}", stream.datagrams, bytes, whence(stream));
}

/** What to write for a stream whose sensor's angles the program cannot know; empty for others. */
std::string wayOut(const SampledStream& stream)
{
  if (stream.samples.empty()) return "";
  const std::vector<std::string> texts = metadataToComplete(stream.samples.front());
  if (texts.empty()) return "";
  return fmt::format(
      "; their sensor has beam angles of its own: put the maker's file of them (here ANGLES.csv) beside the recording, "
      "and a file lidar.json with {}",
      fmt::join(texts, " or "));
}

/** The file that describes packets for the stream's port, but not these; empty if there is none. */
std::string otherDescription(const SampledStream& stream, const std::vector<MetadataCandidate>& unheard)
{
  const auto names_port = [&](const MetadataCandidate& candidate)
  { return stream.port != 0 && candidate.decoder->description().lidar_port == stream.port; };
  const auto found = std::find_if(unheard.begin(), unheard.end(), names_port);
  if (found == unheard.end()) return "";
  return fmt::format(
      "; {} describes packets to this port, but of another size or format (Ouster: udp_profile_lidar): "
      "fetch the sensor's metadata again",
      found->file.string());
}

}  // namespace

void refuseSeveral(const SampledStream& stream, const std::vector<std::size_t>& fitting,
                   const std::vector<MetadataCandidate>& candidates)
{
  std::vector<std::string> files;
  for (const std::size_t i : fitting) files.push_back(candidates[i].file.string());
  throw UsageError(fmt::format("the packets {} fit each of {}: name the right one, --metadata FILE", whence(stream),
                               fmt::join(files, ", ")));
}

void refuseNone(const std::vector<SampledStream>& streams, const std::vector<MetadataCandidate>& candidates,
                const std::vector<std::filesystem::path>& captures)
{
  std::string message = fmt::format("{}: no lidar is recognised", captures.front().string());
  std::vector<std::string> held;
  for (const SampledStream& stream : streams) held.push_back(describe(stream));
  message += held.empty() ? "; there is no datagram" : fmt::format("; there are {}", fmt::join(held, ", "));
  std::string ways_out;
  for (const SampledStream& stream : streams) ways_out += wayOut(stream);
  for (const MetadataCandidate& candidate : candidates) message += "\n  " + whyNot(candidate, streams);
  if (candidates.empty() && ways_out.empty())
    ways_out =
        "; Velodyne, Hesai and Robosense are read, and Ouster: it needs its metadata (JSON) beside the capture, or "
        "--metadata FILE";
  throw UsageError(message + ways_out);
}

std::string leftOut(const SampledStream& stream, const std::vector<MetadataCandidate>& unheard)
{
  return fmt::format("{} are of no lidar with known metadata: left out{}{}", describe(stream), wayOut(stream),
                     otherDescription(stream, unheard));
}
}  // namespace scanloom
