/** Just enough of ROS 2 bags (SQLite storage) for the recorded lidar packets that decoders are tested on. */
#pragma once
#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

#include "base/core/Bytes.h"
#include "base/core/Time.h"

namespace scanloom
{
/** The messages of a bag, CDR encoded, oldest first. */
inline std::vector<std::vector<std::uint8_t>> messagesOf(const std::filesystem::path& bag)
{
  sqlite3* opened = nullptr;
  const int status = sqlite3_open_v2(bag.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  const std::unique_ptr<sqlite3, int (*)(sqlite3*)> database(opened, &sqlite3_close);
  sqlite3_stmt* prepared = nullptr;
  if (status != SQLITE_OK || sqlite3_prepare_v2(database.get(), "SELECT data FROM messages ORDER BY timestamp", -1,
                                                &prepared, nullptr) != SQLITE_OK)
    throw std::runtime_error(bag.string() + ": " + sqlite3_errmsg(database.get()));
  const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> rows(prepared, &sqlite3_finalize);

  std::vector<std::vector<std::uint8_t>> messages;
  while (sqlite3_step(rows.get()) == SQLITE_ROW)
  {
    const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(rows.get(), 0));
    messages.emplace_back(data, data + sqlite3_column_bytes(rows.get(), 0));
  }
  return messages;
}

/** The packets of velodyne_msgs/VelodyneScan messages: header, then a sequence of (stamp, uint8[packet_bytes]). */
inline std::vector<std::vector<std::uint8_t>> packetsOfBag(const std::filesystem::path& bag, std::size_t packet_bytes)
{
  constexpr std::size_t kEncapsulation = 4, kStamp = 8, kLength = 4;
  const auto aligned = [](std::size_t offset) { return (offset + 3) / 4 * 4; };  // to what follows the encapsulation
  std::vector<std::vector<std::uint8_t>> packets;
  for (const std::vector<std::uint8_t>& message : messagesOf(bag))
  {
    std::size_t at = kEncapsulation + kStamp;
    at = aligned(at + kLength + load<std::uint32_t>(message, at));  // frame_id
    const auto count = load<std::uint32_t>(message, at);
    at += kLength;
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const Bytes packet = Bytes(message).slice(aligned(at) + kStamp, packet_bytes);
      packets.emplace_back(packet.begin(), packet.end());
      at = aligned(at) + kStamp + packet_bytes;
    }
  }
  return packets;
}

struct StampedPacket
{
  Timestamp received;
  std::vector<std::uint8_t> bytes;
};

/** A sequence of (stamp, `flag_bytes`, uint8[1500], uint32 used) behind a header. */
inline std::vector<StampedPacket> packetsOfScans(const std::filesystem::path& bag, std::size_t flag_bytes)
{
  constexpr std::size_t kEncapsulation = 4, kStamp = 8, kLength = 4, kField = 1500;
  const auto aligned = [](std::size_t offset) { return (offset + 3) / 4 * 4; };
  std::vector<StampedPacket> packets;
  for (const std::vector<std::uint8_t>& message : messagesOf(bag))
  {
    std::size_t at = kEncapsulation + kStamp;
    at = aligned(at + kLength + load<std::uint32_t>(message, at));  // frame_id
    const auto count = load<std::uint32_t>(message, at);
    at += kLength;
    const std::size_t used = aligned(kStamp + flag_bytes + kField);
    for (std::uint32_t i = 0; i < count; ++i, at += used + kLength)
    {
      const std::chrono::nanoseconds seconds = std::chrono::seconds{load<std::uint32_t>(message, at)};
      const Bytes packet = Bytes(message).slice(at + kStamp + flag_bytes, load<std::uint32_t>(message, at + used));
      packets.push_back({Timestamp{seconds + std::chrono::nanoseconds{load<std::uint32_t>(message, at + 4)}},
                         {packet.begin(), packet.end()}});
    }
  }
  return packets;
}

inline std::vector<std::vector<std::uint8_t>> bytesOf(const std::vector<StampedPacket>& packets)
{
  std::vector<std::vector<std::uint8_t>> bytes;
  for (const StampedPacket& packet : packets) bytes.push_back(packet.bytes);
  return bytes;
}

/** The packets of pandar_msgs/PandarScan messages. */
inline std::vector<StampedPacket> pandarPacketsOfBag(const std::filesystem::path& bag)
{
  return packetsOfScans(bag, 0);
}

/** The packets of robosense_msgs/RobosenseScan messages. */
inline std::vector<StampedPacket> robosensePacketsOfBag(const std::filesystem::path& bag)
{
  return packetsOfScans(bag, 1);
}
}  // namespace scanloom
