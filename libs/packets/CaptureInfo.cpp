#include "packets/CaptureInfo.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "lidar/FrameFields.h"
#include "lidar/LidarModels.h"

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

/** Decodes the datagrams of a capture for one lidar. */
class View
{
 public:
  View(const std::string& metadata_file, Digests digests) : decoder_(makeDecoder(metadata_file, Rigid::identity()))
  {
    decoded_.lidar = decoder_->description();
    if (digests == Digests::No) return;
    const auto* ouster = dynamic_cast<const OusterDecoder*>(decoder_.get());
    if (!ouster)
      throw std::invalid_argument(fmt::format("{}: digests are defined for Ouster packets only", metadata_file));
    fields_.emplace(*ouster);
  }

  void add(Bytes packet)
  {
    const PacketKind kind = decoder_->kind(packet);
    ++decoded_.packets[nameOf(kind)];
    if (kind == PacketKind::Imu) decoded_.imu_samples += decoder_->imuSamples(packet).size();
    if (kind != PacketKind::Lidar) return;

    decoder_->readBlocks(packet, blocks_);
    for (const MeasurementBlock& block : blocks_) addBlock(block);
    if (fields_) addDigests(fields_->push(packet));
  }

  DecodedCapture finish()
  {
    if (fields_) addDigests(fields_->finish());
    return std::move(decoded_);
  }

 private:
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

  void addDigests(const std::vector<FieldFrame>& frames)
  {
    for (const FieldFrame& frame : frames) decoded_.digests.push_back(digestsOf(frame));
  }

  std::unique_ptr<PacketDecoder> decoder_;
  std::optional<FrameFields> fields_;
  std::vector<MeasurementBlock> blocks_;
  DecodedCapture decoded_;
};
}  // namespace

CaptureInfo captureInfo(const std::filesystem::path& path, const std::vector<std::string>& metadata_files,
                        Digests digests)
{
  std::vector<View> views;
  for (const std::string& file : metadata_files) views.emplace_back(file, digests);

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
    for (View& view : views) view.add(datagram.payload);
  }

  CaptureInfo info;
  info.counters = reader.counters();
  for (const auto& [key, stream] : streams) info.streams.push_back(stream);
  for (View& view : views) info.lidars.push_back(view.finish());
  return info;
}
}  // namespace scanloom
