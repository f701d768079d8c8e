#pragma once
#include "base/core/Bytes.h"
#include "base/core/Time.h"

#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace scanloom
{
inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";
inline constexpr std::string_view kMcapProfile = "ros2", kMcapLibrary = "scanloom";  // of the files that we write

/** What a topic's messages are, with their definition as ROS 2 writes it ("ros2msg"). */
struct McapSchema
{
  std::string type;  // "sensor_msgs/msg/Imu"
  std::string definition;
};

/**
 * An MCAP file (mcap.dev, version 0) of messages in CDR: chunks in zstd, each with its index, and a summary. One chunk
 * is in memory.
 */
class McapWriter
{
 public:
  /** The stream must outlive the writer. */
  explicit McapWriter(std::ostream&);

  /** @return what add() calls the topic. */
  std::uint16_t addTopic(const std::string& name, const McapSchema&);

  /** Before 1970 is not possible: such a time becomes 1970. */
  void add(std::uint16_t topic, Timestamp, const std::vector<std::uint8_t>& message);

  /** Nothing may follow. Whether all was written, the stream tells. */
  void close();

 private:
  using Buffer = std::vector<std::uint8_t>;

  struct Entry
  {
    std::uint64_t time = 0, offset = 0;  // of a message's record in the chunk
  };
  struct ChunkPlace
  {
    std::uint64_t first = 0, last = 0;  // times
    std::uint64_t start = 0, length = 0, index_length = 0, packed = 0, unpacked = 0;
    std::map<std::uint16_t, std::uint64_t> indexes;  // where each topic's index is
  };

  void write(const Buffer&);
  void writeRecord(std::uint8_t kind, const Buffer& content);
  void writeChunk();
  void writeIndexes(ChunkPlace&);
  void writeSummary();

  std::ostream& file_;
  std::uint64_t position_ = 0;
  std::vector<Buffer> schemas_, channels_;  // records' contents
  Buffer records_;                          // of the chunk
  std::map<std::uint16_t, std::vector<Entry>> entries_;
  std::vector<ChunkPlace> chunks_;
  std::map<std::uint16_t, std::uint64_t> messages_of_;  // by topic
  std::uint64_t first_ = 0, last_ = 0, messages_ = 0, sequence_ = 0;
  std::uint64_t chunk_first_ = 0, chunk_last_ = 0;
};
}  // namespace scanloom
