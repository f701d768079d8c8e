/** Raw channel fields of Ouster packets, frame by frame, and their digests: to compare with the maker's decoder. */
#pragma once
#include "input/lidar/OusterDecoder.h"

#include <deque>
#include <map>
#include <string>
#include <vector>

namespace scanloom
{
/** One field of all pixels, row by row: a row per channel, a column per measurement block (not destaggered). */
struct FieldImage
{
  std::string name;                  // "RANGE", "NEAR_IR", ...
  std::size_t bytes_per_value = 1;   // unsigned, little-endian
  std::vector<std::uint8_t> values;  // rows x columns x bytes_per_value
};

/** The columns of a turn or of a packet: their headers, and every field of the profile. */
struct FieldFrame
{
  std::uint32_t frame_id = 0;
  std::vector<std::uint64_t> timestamp;       // ns
  std::vector<std::uint64_t> status;          // as in the packet: 16 bits, 32 in LEGACY profiles
  std::vector<std::uint16_t> measurement_id;  // 0 where nothing was received
  std::vector<FieldImage> fields;
};

/** The fields of one lidar packet, columns in its order, invalid ones included. */
FieldFrame fieldsOf(const OusterDecoder&, Bytes lidar_packet);

/**
 * Assembles turns by frame id. Columns that are invalid or missing are zero in all fields. A late packet is still added
 * to its turn until the first packet of the second turn after it arrives.
 */
class FrameFields
{
 public:
  /** The decoder must outlive this. */
  explicit FrameFields(const OusterDecoder& decoder) : decoder_(decoder) {}

  /** Adds a lidar packet. Returns the turns that are complete with it, oldest first. */
  std::vector<FieldFrame> push(Bytes lidar_packet);

  /** Returns the incomplete turns, oldest first. */
  std::vector<FieldFrame> finish();

 private:
  FieldFrame& frameWithId(std::uint32_t frame_id);

  const OusterDecoder& decoder_;
  std::deque<FieldFrame> open_;  // the newest two at most, in order of arrival
};

/** By field name the MD5 of its little-endian values, also of TIMESTAMP, STATUS and MEASUREMENT_ID. FRAME_ID is a
 * number. */
std::map<std::string, std::string> digestsOf(const FieldFrame&);
}  // namespace scanloom
