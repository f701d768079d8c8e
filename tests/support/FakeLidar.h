/** A lidar of three channels whose packets are easy to read in a test. Not for its own sake: the batcher never asks
 * more. */
#pragma once
#include "input/lidar/PacketDecoder.h"

#include <vector>

namespace scanloom
{
struct FakeLidarOptions
{
  int columns_per_frame = 64;
  int columns_per_packet = 8;
  int first_column = 0;
  int last_column = 63;
  double frame_rate = 10;
  Numbering numbering = Numbering::Ids;
  Duration fixed_block_period{0};
  Duration stamp_modulus{0};
  bool has_init_id = false;
  bool has_imu = false;
  std::uint64_t frame_id_modulus = 65536;
};

/**
 * Packet: {u32 init id, u32 flags}, then per block {i64 stamp, u32 frame, u16 measurement id, u16 valid}. The three
 * points carry the stamp in x. IMU packet: {i64 stamp, i64 reading}, the reading is the gyroscope's x.
 */
class FakeLidar : public PacketDecoder
{
 public:
  static constexpr std::size_t kHeaderSize = 8;
  static constexpr std::size_t kBlockSize = 16;
  static constexpr std::size_t kImuSize = 16;

  explicit FakeLidar(const FakeLidarOptions& options = {})
    : has_init_id_(options.has_init_id), has_imu_(options.has_imu)
  {
    description_.model = "fake";
    description_.channels = 3;
    description_.columns_per_frame = options.columns_per_frame;
    description_.columns_per_packet = options.columns_per_packet;
    description_.first_column = options.first_column;
    description_.last_column = options.last_column;
    description_.frame_rate = options.frame_rate;
    description_.frame_id_modulus = options.frame_id_modulus;
    description_.numbering = options.numbering;
    description_.fixed_block_period = options.fixed_block_period;
    description_.stamp_modulus = options.stamp_modulus;
  }

  const LidarDescription& description() const override { return description_; }
  PacketKind kindByHeader(Bytes packet) const override
  {
    if (has_imu_ && packet.size() == kImuSize) return PacketKind::Imu;
    return packet.size() == kHeaderSize + kBlockSize * static_cast<std::size_t>(description_.columns_per_packet)
               ? PacketKind::Lidar
               : PacketKind::Malformed;
  }
  PacketHeader header(Bytes packet) const override
  {
    PacketHeader header;
    header.frame_id = load<std::uint32_t>(packet, kHeaderSize + 8);
    if (has_init_id_) header.init_id = load<std::uint32_t>(packet, 0);
    header.alert_flags = load<std::uint8_t>(packet, 4);
    header.thermal_status = load<std::uint8_t>(packet, 5);
    header.shot_limiting_status = load<std::uint8_t>(packet, 6);
    return header;
  }
  void readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const override
  {
    blocks.clear();
    for (std::size_t at = kHeaderSize; at < packet.size(); at += kBlockSize)
    {
      MeasurementBlock block;
      block.stamp = fromNanoseconds(load<std::int64_t>(packet, at));
      block.frame_id = load<std::uint32_t>(packet, at + 8);
      block.measurement_id = load<std::uint16_t>(packet, at + 12);
      block.valid = load<std::uint16_t>(packet, at + 14) != 0;
      block.index = static_cast<std::uint16_t>((at - kHeaderSize) / kBlockSize);
      blocks.push_back(block);
    }
  }
  void appendPoints(Bytes packet, std::size_t block, std::int32_t t, std::uint8_t sensor_id,
                    PointCloud& points) const override
  {
    const std::size_t at = kHeaderSize + block * kBlockSize;
    const auto stamp = load<std::int64_t>(packet, at);
    const std::size_t first = points.size();
    points.resize(first + 3);
    for (std::size_t i = first; i < first + 3; ++i)
    {
      points.x[i] = static_cast<float>(1e-6 * static_cast<double>(stamp % 1000000000));
      points.t[i] = t;
      points.ring[i] = static_cast<std::uint16_t>(i - first);
      points.column[i] = load<std::uint16_t>(packet, at + 12);
      points.sensor_id[i] = sensor_id;
    }
  }
  std::vector<ImuSample> imuSamples(Bytes packet) const override
  {
    const auto reading = static_cast<double>(load<std::int64_t>(packet, 8));
    return {{fromNanoseconds(load<std::int64_t>(packet, 0)), {reading, 0, 0}, {0, 0, 9.81}}};
  }

  /** Of one block of a lidar packet. */
  static Timestamp stampOf(Bytes packet, int block)
  {
    return fromNanoseconds(load<std::int64_t>(packet, kHeaderSize + kBlockSize * static_cast<std::size_t>(block)));
  }

  static std::vector<std::uint8_t> imuPacket(Timestamp stamp, std::int64_t reading)
  {
    std::vector<std::uint8_t> packet(kImuSize);
    store<std::int64_t>(packet, 0, nanoseconds(stamp));
    store<std::int64_t>(packet, 8, reading);
    return packet;
  }

  /** All packets that this lidar sends in [first, first + length), turn by turn; the first one opens frame `frame`. */
  std::vector<std::vector<std::uint8_t>> drive(Timestamp first, Duration length, std::uint32_t frame = 0) const
  {
    std::vector<std::vector<std::uint8_t>> packets;
    const Duration block = description_.blockPeriod();
    const int per_packet = description_.columns_per_packet;
    int column = 0;
    for (Timestamp t = first; t + block * per_packet <= first + length; t += block * per_packet)
    {
      std::vector<std::uint8_t> packet(kHeaderSize + kBlockSize * static_cast<std::size_t>(per_packet));
      bool any = false;
      for (int b = 0; b < per_packet; ++b)
      {
        const bool valid = inWindow(column + b);
        any |= valid;
        const std::size_t at = kHeaderSize + kBlockSize * static_cast<std::size_t>(b);
        store<std::int64_t>(packet, at, nanoseconds(t + block * b));
        store<std::uint32_t>(packet, at + 8, static_cast<std::uint32_t>(frame % description_.frame_id_modulus));
        store<std::uint16_t>(packet, at + 12, static_cast<std::uint16_t>(column + b));
        store<std::uint16_t>(packet, at + 14, valid ? 1 : 0);
      }
      if (any) packets.push_back(std::move(packet));
      column += per_packet;
      if (column >= description_.columns_per_frame)
      {
        column = 0;
        ++frame;
      }
    }
    return packets;
  }

 private:
  bool inWindow(int c) const
  {
    const int a = description_.first_column, b = description_.last_column;
    return a <= b ? c >= a && c <= b : c >= a || c <= b;
  }

  LidarDescription description_;
  bool has_init_id_;
  bool has_imu_;
};
}  // namespace scanloom
