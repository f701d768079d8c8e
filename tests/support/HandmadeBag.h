/** Bags of every container, written byte by byte from the descriptions of their formats. */
#pragma once
#include <bzlib.h>
#include <lz4frame.h>
#include <sqlite3.h>
#include <zstd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace scanloom
{
struct HandmadeMessage
{
  std::string topic, type;
  std::uint64_t received = 0;  // ns
  std::string data;
};

template <typename Number>
std::string littleEndian(Number value)
{
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

inline std::string withLength(const std::string& bytes)
{
  return littleEndian(static_cast<std::uint32_t>(bytes.size())) + bytes;
}

/** By "lz4", "zstd", "bz2"; "" and "none" leave it as it is. */
inline std::string packed(const std::string& bytes, const std::string& compression)
{
  std::string room(2 * bytes.size() + 1000, '\0');
  std::size_t size = 0;
  if (compression == "lz4") size = LZ4F_compressFrame(room.data(), room.size(), bytes.data(), bytes.size(), nullptr);
  if (compression == "zstd") size = ZSTD_compress(room.data(), room.size(), bytes.data(), bytes.size(), 1);
  if (compression == "bz2")
  {
    auto filled = static_cast<unsigned>(room.size());
    BZ2_bzBuffToBuffCompress(room.data(), &filled, const_cast<char*>(bytes.data()), static_cast<unsigned>(bytes.size()),
                             1, 0, 0);
    size = filled;
  }
  return size == 0 ? bytes : room.substr(0, size);
}

inline std::string mcapRecord(std::uint8_t kind, const std::string& content)
{
  return littleEndian(kind) + littleEndian(static_cast<std::uint64_t>(content.size())) + content;
}

/** All messages in one chunk, each with a channel of its own; without summary. */
inline std::string mcapOf(const std::vector<HandmadeMessage>& messages, const std::string& compression = "")
{
  std::string records;
  std::uint16_t id = 1;
  for (const HandmadeMessage& m : messages)
  {
    records += mcapRecord(3, littleEndian(id) + withLength(m.type) + withLength("ros2msg") + withLength(""));
    records +=
        mcapRecord(4, littleEndian(id) + littleEndian(id) + withLength(m.topic) + withLength("cdr") + withLength(""));
    records += mcapRecord(5, littleEndian(id) + littleEndian(std::uint32_t{0}) + littleEndian(m.received) +
                                 littleEndian(m.received) + m.data);
    ++id;
  }
  const std::string content = packed(records, compression);
  const std::string chunk = littleEndian(std::uint64_t{0}) + littleEndian(std::uint64_t{0}) +
                            littleEndian(static_cast<std::uint64_t>(records.size())) + littleEndian(std::uint32_t{0}) +
                            withLength(compression) + littleEndian(static_cast<std::uint64_t>(content.size())) +
                            content;
  const std::string magic = "\x89MCAP0\r\n";
  return magic + mcapRecord(1, withLength("ros2") + withLength("")) + mcapRecord(6, chunk) +
         mcapRecord(15, littleEndian(std::uint32_t{0})) + mcapRecord(2, std::string(20, '\0')) + magic;
}

inline std::string ros1Record(const std::vector<std::string>& fields, const std::string& data)
{
  std::string header;
  for (const std::string& field : fields) header += withLength(field);
  return withLength(header) + withLength(data);
}

inline std::string ros1Connection(std::uint32_t id, const HandmadeMessage& m)
{
  return ros1Record({"op=\x07", "conn=" + littleEndian(id), "topic=" + m.topic},
                    withLength("topic=" + m.topic) + withLength("type=" + m.type));
}

/** All messages in one chunk, each with a connection of its own; with or without the index behind it. */
inline std::string ros1Of(const std::vector<HandmadeMessage>& messages, const std::string& compression = "none",
                          bool closed = true)
{
  std::string records, index;
  std::uint32_t id = 0;
  for (const HandmadeMessage& m : messages)
  {
    const auto time = littleEndian(static_cast<std::uint32_t>(m.received / 1'000'000'000)) +
                      littleEndian(static_cast<std::uint32_t>(m.received % 1'000'000'000));
    index += ros1Connection(id, m);
    records += ros1Connection(id, m) + ros1Record({"op=\x02", "conn=" + littleEndian(id), "time=" + time}, m.data);
    ++id;
  }
  const std::string chunk = ros1Record(
      {"op=\x05", "compression=" + compression, "size=" + littleEndian(static_cast<std::uint32_t>(records.size()))},
      packed(records, compression));
  const auto begin = [](std::uint64_t index_at)
  {
    return "#ROSBAG V2.0\n" +
           ros1Record({"op=\x03", "index_pos=" + littleEndian(index_at), "conn_count=" + littleEndian(std::uint32_t{0}),
                       "chunk_count=" + littleEndian(std::uint32_t{1})},
                      std::string(100, ' '));
  };
  return closed ? begin(begin(0).size() + chunk.size()) + chunk + index : begin(0) + chunk;
}

inline void writeFile(const std::filesystem::path& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

inline void writeDb3(const std::filesystem::path& path, const std::vector<HandmadeMessage>& messages)
{
  sqlite3* database = nullptr;
  sqlite3_open(path.c_str(), &database);
  const auto run = [&](const std::string& sql)
  {
    if (sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
      throw std::runtime_error(sqlite3_errmsg(database));
  };
  run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT,"
      " offered_qos_profiles TEXT)");
  run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)");
  run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
  int id = 0;
  for (const HandmadeMessage& m : messages)
  {
    ++id;
    run("INSERT INTO topics VALUES(" + std::to_string(id) + ",'" + m.topic + "','" + m.type + "','cdr','')");
    std::string hex;
    for (const unsigned char c : m.data)
    {
      constexpr const char* kDigits = "0123456789abcdef";
      hex += {kDigits[c / 16], kDigits[c % 16]};
    }
    run("INSERT INTO messages VALUES(NULL," + std::to_string(id) + "," + std::to_string(m.received) + ",x'" + hex +
        "')");
  }
  sqlite3_close(database);
}
}  // namespace scanloom
