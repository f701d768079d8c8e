/** Raw channel fields of Ouster packets, frame by frame, and their digests: to compare with the maker's decoder. */
#pragma once
#include "base/core/Digest.h"
#include "input/lidar/OusterDecoder.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <iterator>
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

inline FieldFrame emptyFrame(const OusterLayout& layout, std::uint32_t frame_id, std::size_t columns)
{
  FieldFrame frame;
  frame.frame_id = frame_id;
  frame.timestamp.resize(columns);
  frame.status.resize(columns);
  frame.measurement_id.resize(columns);
  for (std::size_t i = 0; i < kOusterFieldCount; ++i)
  {
    if (!layout.profile->fields[i].present()) continue;
    const OusterFieldType& type = kOusterFieldTypes[i];
    frame.fields.push_back(
        {std::string(type.name), type.bytes, std::vector<std::uint8_t>(layout.channels * columns * type.bytes)});
  }
  return frame;
}

/** Copies one column of `from` to another one of `to`, channel by channel. */
inline void copyColumn(const FieldFrame& from, std::size_t source, FieldFrame& to, std::size_t target,
                       std::size_t channels)
{
  to.timestamp[target] = from.timestamp[source];
  to.status[target] = from.status[source];
  to.measurement_id[target] = from.measurement_id[source];
  for (std::size_t f = 0; f < from.fields.size(); ++f)
  {
    const std::size_t bytes = from.fields[f].bytes_per_value;
    for (std::size_t row = 0; row < channels; ++row)
      std::copy_n(from.fields[f].values.begin() + (row * from.timestamp.size() + source) * bytes, bytes,
                  to.fields[f].values.begin() + (row * to.timestamp.size() + target) * bytes);
  }
}

template <typename T>
std::string md5OfValues(const std::vector<T>& values)
{
  std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return md5(bytes);
}
/** The status word of a column, 32 bits in LEGACY packets and 16 in others. */
inline std::uint32_t columnStatus(const OusterLayout& layout, Bytes packet, std::size_t index)
{
  const Bytes column = packet.slice(layout.columnOffset(index), layout.columnBytes());
  if (layout.isLegacy()) return load<std::uint32_t>(column, column.size() - layout.columnFooterBytes());
  return load<std::uint16_t>(column, kOusterColumnFrameIdOrStatus);
}

inline FieldFrame fieldsOf(const OusterDecoder& decoder, Bytes packet)
{
  const OusterLayout& layout = decoder.layout();
  std::vector<MeasurementBlock> blocks;
  decoder.readBlocks(packet, blocks);
  FieldFrame frame = emptyFrame(layout, decoder.header(packet).frame_id, layout.columns);

  for (std::size_t column = 0; column < layout.columns; ++column)
  {
    frame.timestamp[column] = static_cast<std::uint64_t>(nanoseconds(blocks[column].stamp));
    frame.status[column] = columnStatus(layout, packet, column);
    frame.measurement_id[column] = blocks[column].measurement_id;
    const Bytes channels =
        packet.slice(layout.columnOffset(column) + layout.columnHeaderBytes(), layout.channelsBytes());
    std::size_t image = 0;
    for (const BitField& field : layout.profile->fields)
    {
      if (!field.present()) continue;
      FieldImage& target = frame.fields[image++];
      for (std::size_t row = 0; row < layout.channels; ++row)
      {
        const std::uint32_t value =
            readField(channels.slice(row * layout.profile->channel_bytes, layout.profile->channel_bytes), field);
        std::memcpy(&target.values[(row * layout.columns + column) * target.bytes_per_value], &value,
                    target.bytes_per_value);
      }
    }
  }
  return frame;
}

inline FieldFrame& FrameFields::frameWithId(std::uint32_t frame_id)
{
  const auto known =
      std::find_if(open_.begin(), open_.end(), [&](const FieldFrame& f) { return f.frame_id == frame_id; });
  if (known != open_.end()) return *known;
  const auto columns = static_cast<std::size_t>(decoder_.metadata().columns_per_frame);
  return open_.emplace_back(emptyFrame(decoder_.layout(), frame_id, columns));
}

inline std::vector<FieldFrame> FrameFields::push(Bytes packet)
{
  std::vector<MeasurementBlock> blocks;
  decoder_.readBlocks(packet, blocks);
  const FieldFrame fields = fieldsOf(decoder_, packet);
  // Columns of LEGACY packets have frame ids of their own.
  for (const MeasurementBlock& block : blocks)
    if (block.valid)
      copyColumn(fields, block.index, frameWithId(block.frame_id), block.measurement_id, decoder_.layout().channels);

  std::vector<FieldFrame> complete;
  for (; open_.size() > 2; open_.pop_front()) complete.push_back(std::move(open_.front()));
  return complete;
}

inline std::vector<FieldFrame> FrameFields::finish()
{
  std::vector<FieldFrame> rest(std::make_move_iterator(open_.begin()), std::make_move_iterator(open_.end()));
  open_.clear();
  return rest;
}

inline std::map<std::string, std::string> digestsOf(const FieldFrame& frame)
{
  std::map<std::string, std::string> digests{{"FRAME_ID", std::to_string(frame.frame_id)},
                                             {"TIMESTAMP", md5OfValues(frame.timestamp)},
                                             {"STATUS", md5OfValues(frame.status)},
                                             {"MEASUREMENT_ID", md5OfValues(frame.measurement_id)}};
  for (const FieldImage& image : frame.fields) digests[image.name] = md5(image.values);
  return digests;
}
}  // namespace scanloom
