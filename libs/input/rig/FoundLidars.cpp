#include "input/rig/FoundLidars.h"

#include "base/core/ConfigError.h"
#include "input/lidar/BuiltInModels.h"
#include "input/lidar/LidarModels.h"
#include "input/rig/RigOptions.h"
#include "input/rig/internal/streamMessages.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <tuple>

namespace scanloom
{
namespace
{
using Candidates = std::vector<std::size_t>;  // indices
using Paths = std::vector<std::filesystem::path>;

constexpr std::uint64_t kWorthANote = 100;  // datagrams of a stream that no lidar sends

/** The candidates that understand a packet of the stream as lidar data, most packets first, and how many. */
using Fits = std::map<Candidates, std::size_t>;

/** A packet of one model may look like another's; how much time passes from one to the next does not. */
bool keepsItsPace(const PacketDecoder& decoder, const std::vector<SampledStream::Packet>& packets)
{
  const LidarDescription& lidar = decoder.description();
  if (lidar.fixed_block_period == Duration{0}) return true;
  std::vector<Duration> steps;
  std::vector<MeasurementBlock> blocks;
  std::optional<Timestamp> last;
  Duration expected{0};
  for (const SampledStream::Packet& packet : packets)
  {
    if (decoder.kind(packet) != PacketKind::Lidar) continue;
    decoder.readBlocks(packet, blocks);
    expected = lidar.fixed_block_period * static_cast<std::int64_t>(blocks.size());
    if (last && blocks.front().stamp > *last) steps.push_back(blocks.front().stamp - *last);
    last = blocks.front().stamp;
  }
  if (steps.empty()) return true;  // a packet alone has no pace
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 4), steps.end());
  const double pace = seconds(steps[steps.size() / 4]) / seconds(expected);  // the lower quarter: some may be lost
  return pace > 0.9 && pace < 1.1;
}

/** By the set of candidates that understand it: how many packets. */
Fits fitsOf(const SampledStream& stream, const std::vector<MetadataCandidate>& candidates)
{
  Fits fits;
  Candidates in_pace;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (candidates[i].decoder && keepsItsPace(*candidates[i].decoder, stream.samples)) in_pace.push_back(i);
  for (const SampledStream::Packet& packet : stream.samples)
  {
    Candidates understand;
    for (const std::size_t i : in_pace)
      if (candidates[i].decoder->kind(packet) == PacketKind::Lidar) understand.push_back(i);
    if (!understand.empty()) ++fits[understand];
  }
  return fits;
}

/** A bag's metadata stand beside the packets that they describe. */
bool isOfSameNameSpace(const std::filesystem::path& metadata, const SampledStream& stream)
{
  const std::optional<std::string> topic = topicNamedBy(metadata.string());
  return topic && !stream.topic.empty() && nameSpaceOf(*topic) == nameSpaceOf(stream.topic);
}

/** Those that the test keeps, or all if it keeps none. */
Candidates preferred(const Candidates& candidates, const std::function<bool(std::size_t)>& isBetter)
{
  Candidates better;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(better), isBetter);
  return better.empty() ? candidates : better;
}

bool isNamedLike(const std::filesystem::path& metadata, const Paths& captures)
{
  return std::any_of(captures.begin(), captures.end(),
                     [&](const auto& capture) { return capture.stem().stem() == metadata.stem(); });
}

std::optional<Timestamp> firstStampIn(const SampledStream& stream, const PacketDecoder& decoder)
{
  std::optional<Timestamp> first;
  std::vector<MeasurementBlock> blocks;
  for (const SampledStream::Packet& packet : stream.samples)
  {
    if (decoder.kind(packet) != PacketKind::Lidar) continue;
    decoder.readBlocks(packet, blocks);
    for (const MeasurementBlock& block : blocks)
      if (block.valid && (!first || block.stamp < *first)) first = block.stamp;
  }
  return first;
}

class Search
{
 public:
  Search(const std::vector<SampledStream>& streams, const std::vector<MetadataCandidate>& candidates,
         const Paths& captures)
    : streams_(streams), candidates_(candidates), captures_(captures)
  {
    for (const SampledStream& stream : streams_) fits_.push_back(fitsOf(stream, candidates_));
  }

  LidarsFound result()
  {
    for (std::size_t s = 0; s < streams_.size(); ++s) chooseFor(s);
    for (const SampledStream& stream : streams_) addImu(stream);
    markSharedPorts(found_.lidars);
    for (const MetadataCandidate& candidate : candidates_)
      if (candidate.decoder && !isOfAFoundSensor(candidate)) found_.unheard.push_back(candidate);
    std::sort(found_.lidars.begin(), found_.lidars.end(),
              [](const FoundLidar& a, const FoundLidar& b)
              { return std::tie(a.port, a.source, a.topic) < std::tie(b.port, b.source, b.topic); });
    return std::move(found_);
  }

 private:
  void chooseFor(std::size_t s)
  {
    const SampledStream& stream = streams_[s];
    std::set<std::size_t> chosen;
    for (const auto& [fitting, packets] : fits_[s]) chosen.insert(choose(s, fitting));
    for (const std::size_t i : chosen) found_.lidars.push_back(lidarOf(i, stream));
  }

  std::size_t choose(std::size_t s, const Candidates& fitting) const
  {
    const SampledStream& stream = streams_[s];
    Candidates left = preferred(fitting, [&](std::size_t i) { return isNamedLike(candidates_[i].file, captures_); });
    left = preferred(left, [&](std::size_t i)
                     { return stream.port != 0 && candidates_[i].decoder->description().lidar_port == stream.port; });
    left = preferred(left, [&](std::size_t i) { return topicNamedBy(candidates_[i].file.string()) == stream.topic; });
    left = preferred(left, [&](std::size_t i) { return isOfSameNameSpace(candidates_[i].file, stream); });
    left = preferred(left, [&](std::size_t i) { return !fitsElsewhere(i, s); });
    if (left.size() > 1) refuseSeveral(stream, left, candidates_);
    return left.front();
  }

  bool fitsElsewhere(std::size_t candidate, std::size_t s) const
  {
    for (std::size_t other = 0; other < streams_.size(); ++other)
      for (const auto& [fitting, packets] : fits_[other])
        if (other != s && std::find(fitting.begin(), fitting.end(), candidate) != fitting.end()) return true;
    return false;
  }

  FoundLidar lidarOf(std::size_t candidate, const SampledStream& stream) const
  {
    FoundLidar lidar;
    lidar.metadata = candidates_[candidate].file;
    lidar.description = candidates_[candidate].decoder->description();
    lidar.source = stream.source;
    lidar.port = stream.port;
    lidar.topic = stream.topic;
    lidar.first_stamp = firstStampIn(stream, *candidates_[candidate].decoder);
    return lidar;
  }

  /** IMU packets tell no serial number: they are of the lidar of their address to which the port belongs best. */
  void addImu(const SampledStream& stream)
  {
    FoundLidar* owner = nullptr;
    for (FoundLidar& lidar : found_.lidars)
      if (maySendImu(lidar, stream) && (!owner || isNearer(stream.port, lidar, *owner))) owner = &lidar;
    if (!owner) return;
    const bool has_imu = owner->imu_port != 0 || !owner->imu_topic.empty();
    if (has_imu && distanceOf(owner->imu_port, *owner) <= distanceOf(stream.port, *owner)) return;
    owner->imu_port = stream.port;
    owner->imu_topic = stream.topic;
  }

  bool maySendImu(const FoundLidar& lidar, const SampledStream& stream) const
  {
    if (stream.source != lidar.source || nameSpaceOf(stream.topic) != nameSpaceOf(lidar.topic)) return false;
    const auto candidate = std::find_if(candidates_.begin(), candidates_.end(),
                                        [&](const MetadataCandidate& c) { return c.file == lidar.metadata; });
    return std::any_of(stream.samples.begin(), stream.samples.end(),
                       [&](const SampledStream::Packet& packet)
                       { return candidate->decoder->kind(packet) == PacketKind::Imu; });
  }

  /** Less than 0 if its metadata name the port; a sensor's two ports usually follow each other. All topics of a name
   * space are at the same distance. */
  static int distanceOf(std::uint16_t port, const FoundLidar& lidar)
  {
    if (port == 0) return 0;
    return port == lidar.description.imu_port ? -1 : std::abs(int{port} - int{lidar.port});
  }

  static bool isNearer(std::uint16_t port, const FoundLidar& lidar, const FoundLidar& than)
  {
    return distanceOf(port, lidar) < distanceOf(port, than);
  }

  /** Models of the program, and files without a serial number, describe any sensor of their kind. */
  bool isOfAFoundSensor(const MetadataCandidate& candidate) const
  {
    const LidarDescription& described = candidate.decoder->description();
    return std::any_of(found_.lidars.begin(), found_.lidars.end(),
                       [&](const FoundLidar& lidar)
                       {
                         return lidar.metadata == candidate.file || (lidar.description.model == described.model &&
                                                                     lidar.description.serial == described.serial);
                       }) ||
           builtInMetadata(candidate.file.string());
  }

  const std::vector<SampledStream>& streams_;
  const std::vector<MetadataCandidate>& candidates_;
  const Paths& captures_;
  std::vector<Fits> fits_;  // of each stream
  LidarsFound found_;
};

/** Those whose packets look like the first one of a stream that no candidate fits. */
void addBuiltInModels(const std::vector<SampledStream>& streams, std::vector<MetadataCandidate>& candidates)
{
  Paths models;
  for (const SampledStream& stream : streams)
    if (!stream.samples.empty() && fitsOf(stream, candidates).empty())
      for (const std::string& model : modelsThatSend(stream.samples))
        if (std::find(models.begin(), models.end(), model) == models.end()) models.emplace_back(model);
  for (MetadataCandidate& candidate : candidatesFrom(models)) candidates.push_back(std::move(candidate));
}

/** Its measurements, or what else its sensor sends: positions, state. */
bool isOfALidar(const SampledStream& stream, const std::vector<FoundLidar>& lidars,
                const std::vector<MetadataCandidate>& candidates)
{
  const auto sendsOther = [&](const FoundLidar& lidar)
  {
    const auto candidate = std::find_if(candidates.begin(), candidates.end(),
                                        [&](const MetadataCandidate& c) { return c.file == lidar.metadata; });
    return !stream.samples.empty() && candidate->decoder->kind(stream.samples.front()) == PacketKind::Other;
  };
  return std::any_of(lidars.begin(), lidars.end(),
                     [&](const FoundLidar& lidar)
                     {
                       if (!stream.topic.empty() && (lidar.topic == stream.topic || lidar.imu_topic == stream.topic))
                         return true;
                       if (lidar.source != stream.source) return false;
                       const bool is_its_port = lidar.port == stream.port || lidar.imu_port == stream.port;
                       return (stream.port != 0 && is_its_port) || sendsOther(lidar);
                     });
}
}  // namespace

std::vector<MetadataCandidate> candidatesFrom(const Paths& metadata_files)
{
  std::vector<MetadataCandidate> candidates;
  for (const std::filesystem::path& file : metadata_files) try
    {
      candidates.push_back({file, makeDecoder(file.string(), Rigid::identity()), ""});
    }
    catch (const std::invalid_argument& fault)
    {
      candidates.push_back({file, nullptr, fault.what()});
    }
  return candidates;
}

std::vector<MetadataCandidate> candidatesFrom(const std::map<std::string, std::string>& metadata_by_topic)
{
  std::vector<MetadataCandidate> candidates;
  for (const auto& [topic, text] : metadata_by_topic)
  {
    MetadataCandidate candidate{std::string(kTopicPrefix) + topic, nullptr, ""};
    try
    {
      candidate.decoder = makeDecoder(text, candidate.file.string(), Rigid::identity());
    }
    catch (const std::invalid_argument& fault)
    {
      candidate.fault = fault.what();
    }
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

void markSharedPorts(std::vector<FoundLidar>& lidars)
{
  const auto isOneOf = [](std::uint16_t port, const FoundLidar& lidar)
  { return port != 0 && (port == lidar.port || port == lidar.imu_port); };
  for (FoundLidar& one : lidars)
    for (const FoundLidar& other : lidars)
      if (one.source != other.source && (isOneOf(one.port, other) || isOneOf(one.imu_port, other)))
        one.source_matters = true;
}

std::string nameSpaceOf(const std::string& topic) { return topic.substr(0, topic.rfind('/') + 1); }

LidarsFound findLidars(const std::vector<SampledStream>& streams, std::vector<MetadataCandidate> candidates,
                       const Paths& captures)
{
  addBuiltInModels(streams, candidates);
  LidarsFound found = Search(streams, candidates, captures).result();
  if (found.lidars.empty()) refuseNone(streams, candidates, captures);
  for (const SampledStream& stream : streams)
    if (stream.datagrams >= kWorthANote && !isOfALidar(stream, found.lidars, candidates))
    {
      found.left_streams_out = true;
      found.notes.push_back(leftOut(stream, found.unheard));
    }
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(found.faulty),
               [](const MetadataCandidate& candidate) { return !candidate.decoder; });
  return found;
}
}  // namespace scanloom
