/** The table of Hesai models: what differs between sensors whose packets are built alike. */
#pragma once
#include "base/core/Time.h"
#include "input/lidar/internal/HesaiShots.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace scanloom
{
/** Where things lie behind a packet's blocks, in bytes from the start of the tail. */
struct HesaiTail
{
  std::size_t bytes = 0, return_mode = 0, date = 0, microseconds = 0;
  std::size_t loop = 0;  // a byte whose lowest bit tells which loop two returns are of; 0: none
};

constexpr HesaiTail kHesaiTailOf40P{22, 14, 16, 10, 0};
constexpr HesaiTail kHesaiTailOfXt{28, 10, 13, 19, 0};
constexpr HesaiTail kHesaiTailOfQt64{28, 16, 18, 12, 0};
constexpr HesaiTail kHesaiTailOfQt128{34, 12, 15, 21, 5};

/** A packet: header, blocks of an azimuth and a reading per channel, what lies between, tail, what may follow. */
struct HesaiModel
{
  std::string_view name;
  int channels = 0;
  int blocks = 0;                                       // of a packet with one return; with two, blocks are in pairs
  std::size_t header_bytes = 0;                         // 0, 8 or 12
  std::uint8_t protocol_major = 0, protocol_minor = 0;  // in headers of 12 bytes; 0.0: any
  std::size_t azimuth_at = 0;                           // within a block; flags come before it if there are any
  std::size_t reading_bytes = 4;                        // range, reflectivity and perhaps a confidence
  std::size_t between_bytes = 0;                        // checksum and functional safety
  HesaiTail tail;
  std::size_t optional_bytes = 0;  // that may follow
  Duration block;                  // from one firing of all channels to the next
  bool stamp_begins = false;       // stamps count from a packet's first block; else from its last
  Duration block_after_stamp{0};   // of the block that stamps count from
  const std::int32_t* shots[2]{};  // ns after the block's time, by channel; two where even and odd blocks differ

  std::size_t blockBytes() const { return azimuth_at + 2 + static_cast<std::size_t>(channels) * reading_bytes; }
  std::size_t tailAt() const { return header_bytes + static_cast<std::size_t>(blocks) * blockBytes() + between_bytes; }
  std::size_t packetBytes() const { return tailAt() + tail.bytes; }
};

/**
 * Layouts and times are those of the user manuals (for the QT64 and QT128 as drivers have them). Blocks of the XT32M
 * count from the sixth like the blocks of its packets; drivers count from an eighth, which there is not. The QT128's
 * first block lies before its second one, as azimuths tell; a driver has them reversed.
 */
constexpr std::array<HesaiModel, 7> kHesaiModels{{
    {"40P", 40, 10, 0, 0, 0, 2, 3, 0, kHesaiTailOf40P, 4, 55560ns, false, -28580ns, {kShotsOf40P.data()}},
    {"64", 64, 6, 8, 0, 0, 0, 3, 0, kHesaiTailOf40P, 4, 55560ns, false, -42580ns, {kShotsOf64.data()}},
    {"XT16", 16, 8, 12, 6, 1, 0, 4, 0, kHesaiTailOfXt, 0, 50000ns, false, 5632ns, {kShotsOfXt16.data()}},
    {"XT32", 32, 8, 12, 6, 1, 0, 4, 0, kHesaiTailOfXt, 0, 50000ns, false, 5632ns, {kShotsOfXt32.data()}},
    {"XT32M", 32, 6, 12, 6, 1, 0, 4, 0, kHesaiTailOfXt, 0, 50000ns, false, 5632ns, {kShotsOfXt32M.data()}},
    {"QT64", 64, 4, 12, 0, 0, 0, 4, 0, kHesaiTailOfQt64, 0, 166667ns, true, 25710ns, {kShotsOfQt64.data()}},
    {"QT128",
     128,
     2,
     12,
     3,
     2,
     0,
     4,
     21,
     kHesaiTailOfQt128,
     32,
     111110ns,
     false,
     9000ns,
     {kShotsOfQt128[0].data(), kShotsOfQt128[1].data()}},
}};

/** The row of that name, or null. */
constexpr const HesaiModel* findHesaiModel(std::string_view name)
{
  for (const HesaiModel& model : kHesaiModels)
    if (model.name == name) return &model;
  return nullptr;
}
}  // namespace scanloom
