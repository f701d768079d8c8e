#include "input/lidar/FrameFields.h"

#include "base/core/Digest.h"

#include <algorithm>

namespace scanloom
{
namespace
{
FieldFrame emptyFrame(const OusterLayout& layout, std::uint32_t frame_id, std::size_t columns)
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
void copyColumn(const FieldFrame& from, std::size_t source, FieldFrame& to, std::size_t target, std::size_t channels)
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
}  // namespace

FieldFrame fieldsOf(const OusterDecoder& decoder, Bytes packet)
{
  const OusterLayout& layout = decoder.layout();
  std::vector<MeasurementBlock> blocks;
  decoder.readBlocks(packet, blocks);
  FieldFrame frame = emptyFrame(layout, decoder.header(packet).frame_id, layout.columns);

  for (std::size_t column = 0; column < layout.columns; ++column)
  {
    frame.timestamp[column] = static_cast<std::uint64_t>(nanoseconds(blocks[column].stamp));
    frame.status[column] = decoder.columnStatus(packet, column);
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

FieldFrame& FrameFields::frameWithId(std::uint32_t frame_id)
{
  const auto known =
      std::find_if(open_.begin(), open_.end(), [&](const FieldFrame& f) { return f.frame_id == frame_id; });
  if (known != open_.end()) return *known;
  const auto columns = static_cast<std::size_t>(decoder_.metadata().columns_per_frame);
  return open_.emplace_back(emptyFrame(decoder_.layout(), frame_id, columns));
}

std::vector<FieldFrame> FrameFields::push(Bytes packet)
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

std::vector<FieldFrame> FrameFields::finish()
{
  std::vector<FieldFrame> rest(std::make_move_iterator(open_.begin()), std::make_move_iterator(open_.end()));
  open_.clear();
  return rest;
}

std::map<std::string, std::string> digestsOf(const FieldFrame& frame)
{
  std::map<std::string, std::string> digests{{"FRAME_ID", std::to_string(frame.frame_id)},
                                             {"TIMESTAMP", md5OfValues(frame.timestamp)},
                                             {"STATUS", md5OfValues(frame.status)},
                                             {"MEASUREMENT_ID", md5OfValues(frame.measurement_id)}};
  for (const FieldImage& image : frame.fields) digests[image.name] = md5(image.values);
  return digests;
}
}  // namespace scanloom
