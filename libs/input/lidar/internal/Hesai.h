/** Hesai: packets that are built alike, with one or two returns. */
#pragma once
#include "input/lidar/internal/StampedDecoder.h"

#include <memory>

namespace scanloom
{
/** Where things lie behind a packet's blocks, in bytes from the start of the tail. */
struct HesaiTail
{
  std::size_t bytes = 0, return_mode = 0, date = 0, microseconds = 0;
  std::size_t loop = 0;  // a byte whose lowest bit tells which loop two returns are of; 0: none
};

/** A packet: header, blocks of an azimuth and a reading per channel, what lies between, tail, what may follow. */
struct HesaiModel : StampedModel
{
  std::size_t header_bytes = 0;                         // 0, 8 or 12
  std::uint8_t protocol_major = 0, protocol_minor = 0;  // in headers of 12 bytes; 0.0: any
  std::size_t azimuth_at = 0;                           // within a block; flags come before it if there are any
  std::size_t reading_bytes = 4;                        // range, reflectivity and perhaps a confidence
  std::size_t between_bytes = 0;                        // checksum and functional safety
  HesaiTail tail;
  std::size_t optional_bytes = 0;  // that may follow
  bool stamp_begins = false;       // stamps count from a packet's first block; else from its last
  Duration block_after_stamp{0};   // time of the block that stamps count from
  std::array<ShotTimes, 2> shots;  // after the block's time; two where even and odd blocks differ

  std::size_t blockBytes() const { return azimuth_at + 2 + static_cast<std::size_t>(channels) * reading_bytes; }
  std::size_t tailAt() const { return header_bytes + static_cast<std::size_t>(firings) * blockBytes() + between_bytes; }
  std::size_t packetBytes() const { return tailAt() + tail.bytes; }
};

extern const std::array<HesaiModel, 7> kHesaiModels;

/** The contents of params/lidars/hesai_*.json. Angles are in the order of the packet. */
using HesaiMetadata = StampedMetadata<HesaiModel>;

/** Throws std::invalid_argument with `name`, the key and what is expected. */
HesaiMetadata parseHesaiMetadata(const std::string& text, const std::string& name);

/**
 * Sensor frame: the maker's, y forward at azimuth 0, x to the right, z up. Stamps are UTC by the sensor's clock. All
 * channels have the azimuth of their block, as in the maker's own drivers by default; they fire within 101 us (QT64:
 * 135 us).
 *
 * Foreign is a packet whose header names other channels, blocks or another protocol (packets of the 40P have no
 * header); Other is a position packet; Malformed is also one whose number of returns is not that of the metadata.
 */
std::unique_ptr<PacketDecoder> makeHesai(const HesaiMetadata&, const Rigid& body_T_sensor);
}  // namespace scanloom
