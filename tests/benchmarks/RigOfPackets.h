/** Packets of rigs of lidars in a forest, for benchmarks: one turn per lidar, made once and cycled for ever. */
#pragma once
#include "input/batching/TimeBatcher.h"
#include "input/lidar/OusterDecoder.h"
#include "input/lidar/internal/OusterLayout.h"
#include "input/lidar/simpleMetadata.h"

#include <memory>
#include <random>
#include <string>
#include <vector>

namespace scanloom::bench
{
constexpr std::size_t kPacketsPerTurn = 64;
constexpr int kColumnsPerPacket = 16;
constexpr int kColumnsPerTurn = 1024;
constexpr Duration kTurn = 100ms;
constexpr Duration kBlock = kTurn / kColumnsPerTurn;
constexpr Timestamp kBegin{Duration{std::chrono::hours{24 * 365 * 55}}};
using Packet = std::vector<std::uint8_t>;

enum class Crc
{
  None,
  Valid,
};

inline OusterMetadata sensor(const OusterProfile& profile, int channels)
{
  OusterMetadata m = simpleMetadata(std::string(profile.name), channels, kColumnsPerPacket);
  m.lidar_mode = "1024x10";
  m.columns_per_frame = kColumnsPerTurn;
  m.last_column = kColumnsPerTurn - 1;
  return m;
}

/** A forest: 85 of 100 channels see something; stems, crowns and gaps of the sky are a few channels high. */
class Forest
{
 public:
  std::vector<OusterReading> column(int channels)
  {
    std::vector<OusterReading> readings;
    while (readings.size() < static_cast<std::size_t>(channels))
    {
      const bool sky = upTo(99) < 15;
      const std::uint32_t range = 1000 + upTo(40000);
      for (std::uint32_t i = 1 + upTo(9); i > 0; --i)
      {
        OusterReading reading;
        reading.near_ir = static_cast<std::uint16_t>(16 * upTo(255));
        if (!sky) reading.first = {range + upTo(400), static_cast<std::uint8_t>(upTo(255)), signal()};
        const bool behind_leaves = !sky && upTo(9) < 2;
        if (behind_leaves) reading.second = {range + 1000 + upTo(5000), static_cast<std::uint8_t>(upTo(255)), signal()};
        readings.push_back(reading);
      }
    }
    readings.resize(static_cast<std::size_t>(channels));
    return readings;
  }

 private:
  std::uint32_t upTo(std::uint32_t most) { return std::uniform_int_distribution<std::uint32_t>(0, most)(random_); }
  std::uint16_t signal() { return static_cast<std::uint16_t>(upTo(2000)); }
  std::mt19937 random_{1};
};

/** One lidar's turn of packets, cycled for ever: stamps and frame ids are advanced in place. */
class Turn
{
 public:
  Turn(const OusterMetadata& m, Duration phase, Crc crc)
    : layout_(layoutOf(m)), has_crc_(crc == Crc::Valid && OusterLayout::hasCrc(layout_.lidar_header))
  {
    const OusterEncoder encoder(m);
    Forest forest;
    for (int first = 0; first < kColumnsPerTurn; first += kColumnsPerPacket)
    {
      std::vector<OusterColumn> columns;
      for (int id = first; id < first + kColumnsPerPacket; ++id)
        columns.push_back(
            {kBegin + phase + id * kBlock, 0, static_cast<std::uint16_t>(id), true, forest.column(m.channels)});
      packets_.push_back(encoder.lidarPacket(columns));
      seal(packets_.back());
    }
  }

  const std::vector<Packet>& packets() const { return packets_; }

  /** The same packets one turn later. */
  void advance()
  {
    const ByteField frame_id = headerFields(layout_.lidar_header).frame_id;
    for (Packet& packet : packets_)
    {
      for (std::size_t i = 0; i < layout_.columns; ++i)
      {
        const std::size_t column = layout_.columnOffset(i);
        const auto stamp = load<std::uint64_t>(packet, column) + static_cast<std::uint64_t>(kTurn.count());
        store(packet, column + kOusterColumnStamp, stamp);
        if (layout_.isLegacy()) raise(packet, {column + kOusterColumnFrameIdOrStatus, 2});
      }
      if (!layout_.isLegacy()) raise(packet, frame_id);
      seal(packet);
    }
  }

 private:
  static void raise(Packet& packet, ByteField f)
  {
    const std::uint64_t value = loadUnsigned(packet, f.offset, f.count) + 1;
    std::memcpy(packet.data() + f.offset, &value, f.count);
  }

  void seal(Packet& packet) const
  {
    if (!OusterLayout::hasCrc(layout_.lidar_header)) return;
    const std::size_t end = packet.size() - kOusterCrcBytes;
    store(packet, end, has_crc_ ? crc64(Bytes(packet).slice(0, end)) : 0);  // 0: firmware that computes none
  }

  OusterLayout layout_;
  bool has_crc_;
  std::vector<Packet> packets_;
};

/** The packets of all lidars in the order in which they arrive, each lidar a little later than the one before. */
class Rig
{
 public:
  Rig(const OusterProfile& profile, int channels, int sensors, Crc crc) : metadata_(sensor(profile, channels))
  {
    for (int i = 0; i < sensors; ++i) turns_.emplace_back(metadata_, i * kBlock / sensors, crc);
  }

  std::size_t packetBytes() const { return turns_.front().packets().front().size(); }
  std::size_t packets() const { return turns_.size() * kPacketsPerTurn; }

  /** One decoder per lidar, each with its own place on the machine. */
  template <typename Decoder>
  std::vector<BatchedLidar> lidars(Kernel kernel) const
  {
    std::vector<BatchedLidar> lidars;
    for (std::size_t i = 0; i < turns_.size(); ++i)
    {
      const double n = static_cast<double>(i);
      const Rigid body_T_sensor = Rigid::fromXyzYawPitchRoll(0.5 * n, 1, 2, 0.7 * n, 0.1, -0.05);
      lidars.push_back({std::to_string(i), std::make_shared<Decoder>(metadata_, body_T_sensor, kernel)});
    }
    return lidars;
  }

  /** Calls visit(lidar, packet, received) for one turn. */
  template <typename Visit>
  void forEachPacket(Visit&& visit) const
  {
    Timestamp received = begin_ + 2ms;
    for (std::size_t p = 0; p < kPacketsPerTurn; ++p, received += kColumnsPerPacket * kBlock)
      for (std::size_t i = 0; i < turns_.size(); ++i) visit(i, turns_[i].packets()[p], received);
  }

  void advance()
  {
    begin_ += kTurn;
    for (Turn& turn : turns_) turn.advance();
  }

 private:
  Timestamp begin_ = kBegin;
  OusterMetadata metadata_;
  std::vector<Turn> turns_;
};
}  // namespace scanloom::bench
