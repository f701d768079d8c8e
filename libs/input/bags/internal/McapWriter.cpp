#include "input/bags/internal/McapWriter.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <stdexcept>

namespace scanloom
{
namespace
{
using McapBuffer = std::vector<std::uint8_t>;

constexpr std::size_t kFullChunk = 4 << 20;

enum WrittenRecord : std::uint8_t
{
  kHeaderRecord = 1,
  kFooterRecord = 2,
  kSchemaRecord = 3,
  kChannelRecord = 4,
  kMessageRecord = 5,
  kChunkRecord = 6,
  kMessageIndexRecord = 7,
  kChunkIndexRecord = 8,
  kStatisticsRecord = 11,
  kDataEndRecord = 15,
};

template <typename Number>
void put(McapBuffer& buffer, Number value)
{
  const std::size_t at = buffer.size();
  buffer.resize(at + sizeof value);
  store(buffer, at, value);
}

void putText(McapBuffer& buffer, std::string_view text)
{
  put(buffer, static_cast<std::uint32_t>(text.size()));
  buffer.insert(buffer.end(), text.begin(), text.end());
}

void putRecord(McapBuffer& buffer, std::uint8_t kind, const McapBuffer& content)
{
  put(buffer, kind);
  put(buffer, static_cast<std::uint64_t>(content.size()));
  buffer.insert(buffer.end(), content.begin(), content.end());
}

McapBuffer zstdOf(const McapBuffer& bytes)
{
  McapBuffer packed(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 1);
  if (ZSTD_isError(size)) throw std::bad_alloc();
  packed.resize(size);
  return packed;
}

/** Pairs of u16 and u64, led by the length of all in bytes. */
void putMap(McapBuffer& buffer, const std::map<std::uint16_t, std::uint64_t>& map)
{
  put(buffer, static_cast<std::uint32_t>(map.size() * (2 + 8)));
  for (const auto& [key, value] : map)
  {
    put(buffer, key);
    put(buffer, value);
  }
}
}  // namespace

McapWriter::McapWriter(std::ostream& file) : file_(file)
{
  write({kMcapMagic.begin(), kMcapMagic.end()});
  Buffer header;
  putText(header, kMcapProfile);
  putText(header, kMcapLibrary);
  writeRecord(kHeaderRecord, header);
}

std::uint16_t McapWriter::addTopic(const std::string& name, const McapSchema& schema)
{
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  Buffer described;
  put(described, id);
  putText(described, schema.type);
  putText(described, "ros2msg");
  putText(described, schema.definition);
  Buffer channel;
  put(channel, id);
  put(channel, id);  // of the schema
  putText(channel, name);
  putText(channel, "cdr");
  put(channel, std::uint32_t{0});  // nothing further
  putRecord(records_, kSchemaRecord, described);
  putRecord(records_, kChannelRecord, channel);
  schemas_.push_back(std::move(described));
  channels_.push_back(std::move(channel));
  return id;
}

void McapWriter::add(std::uint16_t topic, Timestamp stamp, const std::vector<std::uint8_t>& message)
{
  const auto time = static_cast<std::uint64_t>(std::max<std::int64_t>(nanoseconds(stamp), 0));
  chunk_first_ = entries_.empty() ? time : std::min(chunk_first_, time);
  chunk_last_ = entries_.empty() ? time : std::max(chunk_last_, time);
  entries_[topic].push_back({time, records_.size()});
  ++messages_of_[topic];
  Buffer record;
  put(record, topic);
  put(record, static_cast<std::uint32_t>(sequence_++));
  put(record, time);
  put(record, time);
  record.insert(record.end(), message.begin(), message.end());
  putRecord(records_, kMessageRecord, record);
  if (records_.size() >= kFullChunk) writeChunk();
}

void McapWriter::close()
{
  if (!records_.empty()) writeChunk();
  Buffer no_checksum;
  put(no_checksum, std::uint32_t{0});
  writeRecord(kDataEndRecord, no_checksum);
  const std::uint64_t summary = position_;
  writeSummary();
  Buffer footer;
  put(footer, summary);
  put(footer, std::uint64_t{0});  // no offsets into the summary
  put(footer, std::uint32_t{0});
  writeRecord(kFooterRecord, footer);
  write({kMcapMagic.begin(), kMcapMagic.end()});
}

void McapWriter::write(const Buffer& bytes)
{
  file_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  position_ += bytes.size();
}

void McapWriter::writeRecord(std::uint8_t kind, const Buffer& content)
{
  Buffer record;
  putRecord(record, kind, content);
  write(record);
}

void McapWriter::writeChunk()
{
  ChunkPlace place;
  place.first = chunk_first_;
  place.last = chunk_last_;
  place.start = position_;
  place.unpacked = records_.size();
  const Buffer packed = zstdOf(records_);
  place.packed = packed.size();
  Buffer chunk;
  put(chunk, place.first);
  put(chunk, place.last);
  put(chunk, place.unpacked);
  put(chunk, static_cast<std::uint32_t>(::crc32_z(0, records_.data(), records_.size())));
  putText(chunk, "zstd");
  put(chunk, place.packed);
  chunk.insert(chunk.end(), packed.begin(), packed.end());
  writeRecord(kChunkRecord, chunk);
  place.length = position_ - place.start;
  writeIndexes(place);
  first_ = messages_ == 0 ? place.first : std::min(first_, place.first);
  last_ = std::max(last_, place.last);
  for (const auto& [topic, entries] : entries_) messages_ += entries.size();
  chunks_.push_back(std::move(place));
  records_.clear();
  entries_.clear();
}

void McapWriter::writeIndexes(ChunkPlace& place)
{
  const std::uint64_t start = position_;
  for (auto& [topic, entries] : entries_)
  {
    place.indexes[topic] = position_;
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.time < b.time; });
    Buffer index;
    put(index, topic);
    put(index, static_cast<std::uint32_t>(entries.size() * (8 + 8)));
    for (const Entry& entry : entries)
    {
      put(index, entry.time);
      put(index, entry.offset);
    }
    writeRecord(kMessageIndexRecord, index);
  }
  place.index_length = position_ - start;
}

void McapWriter::writeSummary()
{
  for (const Buffer& schema : schemas_) writeRecord(kSchemaRecord, schema);
  for (const Buffer& channel : channels_) writeRecord(kChannelRecord, channel);
  Buffer statistics;
  put(statistics, messages_);
  put(statistics, static_cast<std::uint16_t>(schemas_.size()));
  put(statistics, static_cast<std::uint32_t>(channels_.size()));
  put(statistics, std::uint32_t{0});  // attachments
  put(statistics, std::uint32_t{0});  // further metadata
  put(statistics, static_cast<std::uint32_t>(chunks_.size()));
  put(statistics, first_);
  put(statistics, last_);
  putMap(statistics, messages_of_);
  writeRecord(kStatisticsRecord, statistics);
  for (const ChunkPlace& chunk : chunks_)
  {
    Buffer index;
    for (const std::uint64_t field : {chunk.first, chunk.last, chunk.start, chunk.length}) put(index, field);
    putMap(index, chunk.indexes);
    put(index, chunk.index_length);
    putText(index, "zstd");
    put(index, chunk.packed);
    put(index, chunk.unpacked);
    writeRecord(kChunkIndexRecord, index);
  }
}
}  // namespace scanloom
