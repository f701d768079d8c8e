/** Raw channel fields, turn by turn, as the maker's tools show them: for digests against reference decodes. */
#pragma once
#include "lidar/OusterDecoder.h"

#include <deque>
#include <map>
#include <string>
#include <vector>

namespace scanloom
{
/** One field of every pixel: rows are channels, columns are columns (as measured, not destaggered), row by row. */
struct FieldImage
{
  std::string name;                  // "RANGE", "NEAR_IR", ...
  std::size_t bytes_per_value = 1;   // unsigned, little-endian
  std::vector<std::uint8_t> values;  // rows x columns x bytes_per_value
};

/** A turn or a packet: the headers of its columns and every field that the profile has. */
struct FieldFrame
{
  std::uint32_t frame_id = 0;
  std::vector<std::uint64_t> timestamp;       // ns
  std::vector<std::uint64_t> status;          // as in the packet: 16 bits, 32 in LEGACY profiles
  std::vector<std::uint16_t> measurement_id;  // 0 where nothing was received
  std::vector<FieldImage> fields;
};

/** A lidar packet alone, in its own order of columns, the invalid ones as they stand there. */
FieldFrame fieldsOf(const OusterDecoder&, Bytes lidar_packet);

/**
 * Puts packets together into turns by their frame id. Columns that are invalid or never came are zero everywhere. A
 * packet that comes late still finds its turn as long as no packet of the second turn after it has come.
 */
class FrameFields
{
 public:
  /** The decoder must outlive this. */
  explicit FrameFields(const OusterDecoder& decoder) : decoder_(decoder) {}

  /** The turns that this lidar packet completes, oldest first. */
  std::vector<FieldFrame> push(Bytes lidar_packet);

  /** What is still under construction, oldest first. */
  std::vector<FieldFrame> finish();

 private:
  FieldFrame& frameWithId(std::uint32_t frame_id);

  const OusterDecoder& decoder_;
  std::deque<FieldFrame> open_;  // the newest two at most, in order of arrival
};

/** Field name to MD5 of its little-endian values, with TIMESTAMP, STATUS, MEASUREMENT_ID and, as a number, FRAME_ID. */
std::map<std::string, std::string> digestsOf(const FieldFrame&);
}  // namespace scanloom
