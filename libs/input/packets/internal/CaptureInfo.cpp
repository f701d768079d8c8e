#include "input/packets/internal/CaptureInfo.h"

#include "input/lidar/LidarModels.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <set>
#include <utility>

namespace scanloom
{
namespace
{
const char* nameOf(PacketKind kind)
{
  switch (kind)
  {
    case PacketKind::Lidar:
      return "lidar";
    case PacketKind::Imu:
      return "imu";
    case PacketKind::Other:
      return "other";
    case PacketKind::Malformed:
      return "malformed";
    case PacketKind::BadCrc:
      return "bad_crc";
    case PacketKind::Foreign:
      return "foreign";
  }
  return "";
}

constexpr const char* kImuOfSeveral = "imu_of_several";

/** Decodes the datagrams of a capture for one lidar. */
class View
{
 public:
  explicit View(const std::string& metadata_file) : decoder_(makeDecoder(metadata_file, Rigid::identity()))
  {
    decoded_.lidar = decoder_->description();
  }

  void add(const Datagram& datagram)
  {
    const Bytes packet = datagram.payload;
    const PacketKind kind = decoder_->kind(packet);
    if (kind == PacketKind::Imu && !decoder_->header(packet).serial)
    {
      ImuPackets& imu = imu_without_serial_[{datagram.source, datagram.destination_port}];
      ++imu.packets;
      imu.samples += decoder_->imuSamples(packet).size();
      return;
    }
    ++decoded_.packets[nameOf(kind)];
    if (kind == PacketKind::Imu) decoded_.imu_samples += decoder_->imuSamples(packet).size();
    if (kind != PacketKind::Lidar) return;

    sends_from_.insert(datagram.source);
    decoder_->readBlocks(packet, blocks_);
    for (const MeasurementBlock& block : blocks_) addBlock(block);
  }

  /** An IMU packet without serial number is of the lidar that sends from its address: of `views`, by their packets. */
  void creditImu(const std::vector<View>& views)
  {
    for (const auto& [stream, imu] : imu_without_serial_)
    {
      const std::string kind = kindOfImu(stream, views);
      decoded_.packets[kind] += imu.packets;
      if (kind == nameOf(PacketKind::Imu)) decoded_.imu_samples += imu.samples;
    }
  }

  DecodedCapture finish() { return std::move(decoded_); }

 private:
  using Stream = std::pair<IpAddress, std::uint16_t>;  // source, destination port

  struct ImuPackets
  {
    std::uint64_t packets = 0, samples = 0;
  };

  const char* kindOfImu(const Stream& stream, const std::vector<View>& views) const
  {
    std::vector<const View*> possible;
    for (const View& view : views)
      if (view.maySend(stream, views)) possible.push_back(&view);
    if (possible.size() > 1)
    {
      const auto is_elsewhere = [&](const View* view) { return view->decoded_.lidar.imu_port != stream.second; };
      const auto elsewhere = std::stable_partition(possible.begin(), possible.end(), std::not_fn(is_elsewhere));
      if (elsewhere != possible.begin()) possible.erase(elsewhere, possible.end());
    }
    if (std::find(possible.begin(), possible.end(), this) == possible.end()) return nameOf(PacketKind::Foreign);
    return possible.size() == 1 ? nameOf(PacketKind::Imu) : kImuOfSeveral;
  }

  /** A lidar that is in the capture sends its IMU packets from the address of its lidar packets. */
  bool maySend(const Stream& imu, const std::vector<View>& views) const
  {
    if (imu_without_serial_.count(imu) == 0) return false;
    const auto sendsFromThere = [&](const View& view) { return view.sends_from_.count(imu.first) > 0; };
    return sendsFromThere(*this) || (sends_from_.empty() && std::none_of(views.begin(), views.end(), sendsFromThere));
  }

  void addBlock(const MeasurementBlock& block)
  {
    if (!block.valid)
    {
      ++decoded_.invalid_blocks;
      return;
    }
    if (decoded_.valid_blocks++ == 0) decoded_.first = decoded_.last = block.stamp;
    decoded_.first = std::min(decoded_.first, block.stamp);
    decoded_.last = std::max(decoded_.last, block.stamp);
  }

  std::unique_ptr<PacketDecoder> decoder_;
  std::set<IpAddress> sends_from_;  // lidar packets
  std::map<Stream, ImuPackets> imu_without_serial_;
  std::vector<MeasurementBlock> blocks_;
  DecodedCapture decoded_;
};
}  // namespace

CaptureInfo captureInfo(const std::filesystem::path& path, const std::vector<std::string>& metadata_files)
{
  std::vector<View> views;
  for (const std::string& file : metadata_files) views.emplace_back(file);

  CaptureReader reader(path);
  std::map<std::pair<IpAddress, std::uint16_t>, CaptureStream> streams;
  for (Datagram datagram; reader.next(datagram);)
  {
    CaptureStream& stream = streams[{datagram.source, datagram.destination_port}];
    const std::size_t size = datagram.payload.size();
    if (stream.datagrams++ == 0)
      stream = {datagram.source, datagram.destination_port, 1, size, size, datagram.received, datagram.received};
    stream.smallest = std::min(stream.smallest, size);
    stream.largest = std::max(stream.largest, size);
    stream.last = datagram.received;
    for (View& view : views) view.add(datagram);
  }

  CaptureInfo info;
  info.counters = reader.counters();
  for (const auto& [key, stream] : streams) info.streams.push_back(stream);
  for (View& view : views) view.creditImu(views);
  for (View& view : views) info.lidars.push_back(view.finish());
  return info;
}
}  // namespace scanloom
