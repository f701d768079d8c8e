#include "input/rig/PacketRouter.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr std::size_t kMostOrigins = 1000;
constexpr std::size_t kMostSendersReported = 20;
constexpr int kPacketsElsewhere = 50;  // at a wrong port, until it is reported: a tenth of a second
constexpr std::size_t kMostPlacesWatched = 100;

/** How badly a decoder understands a packet: only the candidates that understand it best are kept. */
int strangeness(PacketKind kind)
{
  switch (kind)
  {
    case PacketKind::Lidar:
    case PacketKind::Imu:
    case PacketKind::Other:
      return 0;
    case PacketKind::BadCrc:
      return 1;
    case PacketKind::Malformed:
      return 2;
    case PacketKind::Foreign:
      return 3;
  }
  return 3;
}

bool isUnderstood(PacketKind kind) { return strangeness(kind) == 0; }

bool listensTo(const LidarAddress& address, const DatagramView& datagram)
{
  return (!address.source || *address.source == datagram.source) &&
         address.receives(datagram.destination_port, datagram.topic);
}

/** "port 7502", "topic /left/packets" */
std::string placeOf(std::uint16_t port, std::string_view topic)
{
  return topic.empty() ? fmt::format("port {}", port) : fmt::format("topic {}", topic);
}

void refuseWithoutPort(const std::string& label, const LidarAddress& address)
{
  if (address.lidar_port == 0 && address.topic.empty())
    throw std::invalid_argument(
        fmt::format("lidar '{}' has no UDP port: give its key 'port', or metadata that names one", label));
}
}  // namespace

bool LidarAddress::receives(std::uint16_t port, std::string_view message_topic) const
{
  if (!message_topic.empty()) return message_topic == topic || message_topic == imu_topic;
  return port != 0 && (port == lidar_port || port == imu_port);
}

std::string Origin::text() const
{
  return topic.empty() ? fmt::format("from {} to port {}", source.text(), destination_port)
                       : fmt::format("on topic {}", topic);
}

Origin originOf(const DatagramView& datagram)
{
  return {datagram.destination_port, datagram.source, std::string(datagram.topic)};
}

PacketRouter::PacketRouter(std::vector<RoutedLidar> lidars)
  : lidars_(std::move(lidars)),
    senders_(lidars_.size()),
    of_other_senders_(lidars_.size(), 0),
    received_(lidars_.size())
{
  for (LidarIndex i = 0; i < lidars_.size(); ++i) replace(i, lidars_[i].address, lidars_[i].decoder);
}

void PacketRouter::replace(LidarIndex lidar, const LidarAddress& address, const PacketDecoder* decoder)
{
  refuseWithoutPort(lidars_[lidar].label, address);
  lidars_[lidar].address = address;
  lidars_[lidar].decoder = decoder;
  if (decoder) senders_[lidar].emplace(decoder->description());
}

std::optional<RoutedPacket> PacketRouter::route(const DatagramView& datagram)
{
  const std::optional<Candidate> lidar = decide(datagram);
  const LidarSender::Verdict sender = lidar ? judgeSender(*lidar, datagram) : LidarSender::Verdict::Refused;
  if (sender == LidarSender::Verdict::Refused)
  {
    ++unmatched_[countedOrigin(datagram)];
    if (!lidar) noticeWrongPort(datagram);
    if (!lidar) noticeOtherSensor(datagram);
    return std::nullopt;
  }
  Received& received = received_[lidar->lidar];
  received.lidar |= lidar->kind == PacketKind::Lidar;
  received.imu |= lidar->kind == PacketKind::Imu;
  RoutedPacket packet =
      readPacket(lidar->lidar, *lidars_[lidar->lidar].decoder, lidar->kind, datagram.payload, datagram.received);
  packet.of_new_sender = sender == LidarSender::Verdict::TakesOver;
  return packet;
}

/** Packets that are not understood are counted for the lidar whoever sends them. */
LidarSender::Verdict PacketRouter::judgeSender(const Candidate& candidate, const DatagramView& datagram)
{
  LidarSender& sender = *senders_[candidate.lidar];
  const std::optional<IpAddress> kept = sender.address();
  LidarSender::Verdict verdict = LidarSender::Verdict::Kept;
  if (candidate.kind == PacketKind::Lidar) verdict = sender.judge(datagram.source, datagram.received);
  if (candidate.kind == PacketKind::Imu && kept && *kept != datagram.source) verdict = LidarSender::Verdict::Refused;
  if (verdict == LidarSender::Verdict::Kept) return verdict;
  of_other_senders_[candidate.lidar] += verdict == LidarSender::Verdict::Refused;
  warnOfSender(candidate.lidar, datagram.source, *kept, verdict);
  return verdict;
}

void PacketRouter::warnOfSender(LidarIndex lidar, const IpAddress& source, const IpAddress& kept,
                                LidarSender::Verdict verdict)
{
  const bool is_reported =
      reported_senders_.size() >= kMostSendersReported || !reported_senders_.emplace(lidar, source).second;
  if (verdict == LidarSender::Verdict::Refused && !is_reported)
    warnings_.push_back(fmt::format(
        "lidar '{}': {} sends packets like those of {}, at port {}: they are left out and counted; give the lidar its "
        "key 'address' (the sensor's own IP address)",
        lidars_[lidar].label, source.text(), kept.text(), lidars_[lidar].address.lidar_port));
  if (verdict == LidarSender::Verdict::TakesOver)
    warnings_.push_back(
        fmt::format("lidar '{}': its packets come from {} now, no longer from {}; if that is not the lidar, give the "
                    "lidar its key 'address' (the sensor's own IP address)",
                    lidars_[lidar].label, source.text(), kept.text()));
}

/** A network can have more senders than memory should be spent on. */
Origin PacketRouter::countedOrigin(const DatagramView& datagram) const
{
  const Origin origin = originOf(datagram);
  return unmatched_.size() < kMostOrigins || unmatched_.count(origin) > 0 ? origin : Origin{};
}

std::optional<PacketRouter::Candidate> PacketRouter::decide(const DatagramView& datagram)
{
  Candidates best = bestOf(listenersTo(datagram), datagram.payload);
  if (best.size() > 1) best = fromKnownSource(best, datagram.source);
  if (best.size() == 1) return best.front();
  if (std::any_of(best.begin(), best.end(), [](const Candidate& c) { return c.kind == PacketKind::Lidar; }))
    warnOfAmbiguity(datagram, best);
  return std::nullopt;
}

/** By port and source address, with what the header says. */
PacketRouter::Candidates PacketRouter::listenersTo(const DatagramView& datagram) const
{
  // Lidars that name this very source do not share it with those that take any.
  const bool named =
      std::any_of(lidars_.begin(), lidars_.end(),
                  [&](const RoutedLidar& lidar) { return lidar.address.source && listensTo(lidar.address, datagram); });
  Candidates candidates;
  for (LidarIndex i = 0; i < lidars_.size(); ++i)
  {
    const RoutedLidar& lidar = lidars_[i];
    if (lidar.decoder && listensTo(lidar.address, datagram) && lidar.address.source.has_value() == named)
      candidates.push_back({i, lidar.decoder->kindByHeader(datagram.payload)});
  }
  return candidates;
}

/** Those that understand the packet best; none if it is foreign to all. */
PacketRouter::Candidates PacketRouter::bestOf(Candidates candidates, Bytes packet) const
{
  // The checksum is computed for whom the header names. If it names nobody, the serial number itself may be damaged.
  const bool any_understands =
      std::any_of(candidates.begin(), candidates.end(), [](const Candidate& c) { return isUnderstood(c.kind); });
  int best = strangeness(PacketKind::Malformed);
  for (Candidate& c : candidates)
  {
    const bool in_question = any_understands ? isUnderstood(c.kind) : c.kind == PacketKind::Foreign;
    if (in_question && !lidars_[c.lidar].decoder->isIntact(packet)) c.kind = PacketKind::BadCrc;
    best = std::min(best, strangeness(c.kind));
  }
  const auto worse = [best](const Candidate& c) { return strangeness(c.kind) > best; };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), worse), candidates.end());
  return candidates;
}

/** Those that have sent from this address before; all if none has. */
PacketRouter::Candidates PacketRouter::fromKnownSource(const Candidates& candidates, const IpAddress& source) const
{
  Candidates from_there;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(from_there),
               [&](const Candidate& c) { return senders_[c.lidar]->address() == source; });
  return from_there.empty() ? candidates : from_there;
}

/** Of a lidar that is not received where it should be, if it can be no other one's. */
void PacketRouter::noticeWrongPort(const DatagramView& datagram)
{
  Candidates missing;
  for (LidarIndex i = 0; i < lidars_.size(); ++i)
  {
    const LidarAddress& address = lidars_[i].address;
    if (!lidars_[i].decoder || address.key.empty() || (address.source && *address.source != datagram.source)) continue;
    const PacketKind kind = lidars_[i].decoder->kindByHeader(datagram.payload);
    // IMU packets hold no serial number: those of a sensor that is not there are another one's.
    const bool is_there = received_[i].lidar || isElsewhere(i);
    const bool is_sought = (kind == PacketKind::Lidar && !received_[i].lidar) ||
                           (kind == PacketKind::Imu && !received_[i].imu && is_there);
    if (is_sought && lidars_[i].decoder->isIntact(datagram.payload)) missing.push_back({i, kind});
  }
  if (missing.size() != 1) return;
  const auto [lidar, kind] = missing.front();
  if (!isDueToReport(lidar, kind, datagram)) return;
  const LidarAddress& address = lidars_[lidar].address;
  const bool is_imu = kind == PacketKind::Imu;
  const std::string key = fmt::format("{}{}", address.key, is_imu ? "_imu" : "");
  const std::string of = fmt::format("lidar '{}': its {}packets come", lidars_[lidar].label, is_imu ? "IMU " : "");
  const std::uint16_t port = datagram.destination_port;
  warnings_.push_back(datagram.topic.empty()
                          ? fmt::format("{} to port {}, not to {}: set {}_port = {}", of, port,
                                        is_imu ? address.imu_port : address.lidar_port, key, port)
                          : fmt::format("{} on topic {}: set {}_topic = {}", of, datagram.topic, key, datagram.topic));
}

/** At the port of a lidar that is not received, by the serial number: the metadata are another sensor's. */
void PacketRouter::noticeOtherSensor(const DatagramView& datagram)
{
  for (const Candidate& candidate : listenersTo(datagram))
  {
    const PacketDecoder& decoder = *lidars_[candidate.lidar].decoder;
    if (candidate.kind != PacketKind::Foreign || received_[candidate.lidar].lidar) continue;
    const auto serial = decoder.header(datagram.payload).serial;
    if (!serial || !decoder.isIntact(datagram.payload) || !isDueToReport(candidate.lidar, candidate.kind, datagram))
      continue;
    warnings_.push_back(
        fmt::format("lidar '{}': packets to {} are of serial number {}, its metadata are of {}: give those of {}",
                    lidars_[candidate.lidar].label, placeOf(datagram.destination_port, datagram.topic), *serial,
                    decoder.description().serial, *serial));
  }
}

/** Once, after so many of these packets. */
bool PacketRouter::isDueToReport(LidarIndex lidar, PacketKind kind, const DatagramView& datagram)
{
  if (elsewhere_.size() >= kMostPlacesWatched) return false;
  return ++elsewhere_[{lidar, kind, placeOf(datagram.destination_port, datagram.topic)}] == kPacketsElsewhere;
}

bool PacketRouter::isElsewhere(LidarIndex lidar) const
{
  return std::any_of(elsewhere_.begin(), elsewhere_.end(),
                     [&](const auto& found)
                     {
                       const auto& [of, kind, place] = found.first;
                       return of == lidar && kind == PacketKind::Lidar;
                     });
}

/** One damaged packet must not end a run, and where all are ambiguous the lidars are silent: that is reported at the
 * end.
 */
void PacketRouter::warnOfAmbiguity(const DatagramView& datagram, const Candidates& candidates)
{
  const std::string place = placeOf(datagram.destination_port, datagram.topic);
  if (!ambiguous_places_.insert(place).second) return;
  std::vector<std::string> labels;
  for (const Candidate& candidate : candidates) labels.push_back(lidars_[candidate.lidar].label);
  warnings_.push_back(fmt::format(
      "a lidar packet from {} at {} may be of '{}': it holds no serial number, and is left out and counted, as all "
      "like it; give each of these lidars its key 'address' (the sensor's own IP address) or a 'port' of its own",
      datagram.source.text(), place, fmt::join(labels, "' or '")));
}
}  // namespace scanloom
