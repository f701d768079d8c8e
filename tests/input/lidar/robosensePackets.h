/** Robosense packets put together by hand, and sensors that send them. */
#pragma once
#include "input/lidar/internal/Robosense.h"

#include <nlohmann/json.hpp>

#include <ctime>
#include <string>
#include <vector>

#include "decoding.h"

namespace scanloom
{
/** The text of a metadata file, with angles of their own for all channels; these are no real unit's. */
inline std::string robosenseText(const RobosenseModel& model, int returns = 1)
{
  std::vector<double> vertical, offset;
  for (int i = 0; i < model.channels; ++i)
  {
    vertical.push_back(15 - 70.0 * i / model.channels);
    offset.push_back(4 * (i % 2) - 2);
  }
  return nlohmann::json{{"lidar", "robosense"},
                        {"model", model.name},
                        {"returns", returns},
                        {"vertical_angles_deg", vertical},
                        {"azimuth_offsets_deg", offset}}
      .dump();
}

inline std::unique_ptr<PacketDecoder> robosenseDecoder(const RobosenseModel& model, int returns = 1)
{
  return makeRobosense(parseRobosenseMetadata(robosenseText(model, returns), "its file"), Rigid::identity());
}

inline void storeBigEndian(std::vector<std::uint8_t>& bytes, std::size_t offset, std::uint64_t value, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
    bytes.at(offset + i) = static_cast<std::uint8_t>(value >> 8 * (count - 1 - i));
}

/** What the packet says; every channel sees `range_counts` of the model's unit, in a second return `second_counts`. */
struct RobosenseContent
{
  std::uint64_t seconds = 1'700'000'000;
  std::uint32_t microseconds = 500'000;
  int returns = 1;
  int azimuth = 0, step = 20;  // of the first firing, and to the next one; 0.01 degrees
  std::uint16_t range_counts = 800, second_counts = 1200;
};

inline void storeRobosenseTime(std::vector<std::uint8_t>& packet, const RobosenseModel& model,
                               const RobosenseContent& content)
{
  if (model.clock == RobosenseClock::Seconds)
  {
    storeBigEndian(packet, 20, content.seconds, 6);
    storeBigEndian(packet, 26, content.microseconds, 4);
    return;
  }
  const auto seconds = static_cast<std::time_t>(content.seconds);
  std::tm date{};
  gmtime_r(&seconds, &date);
  const int fields[] = {date.tm_year - 100, date.tm_mon + 1, date.tm_mday, date.tm_hour, date.tm_min, date.tm_sec};
  for (std::size_t i = 0; i < 6; ++i) packet.at(20 + i) = static_cast<std::uint8_t>(fields[i]);
  storeBigEndian(packet, 26, content.microseconds / 1000, 2);
  storeBigEndian(packet, 28, content.microseconds % 1000, 2);
}

inline std::vector<std::uint8_t> robosensePacket(const RobosenseModel& model, const RobosenseContent& content)
{
  std::vector<std::uint8_t> packet(kRobosensePacketBytes, 0);
  storeBigEndian(packet, 0, model.marker, 4);
  packet[17] = 1;
  storeRobosenseTime(packet, model, content);
  packet[30] = model.type;
  packet[31] = model.version;
  for (int slot = 0; slot < 12 * 32; ++slot)
  {
    const int firing = slot / (model.channels * content.returns);
    const auto block = static_cast<std::size_t>(42 + slot / 32 * 100), at = block + 4 + slot % 32 * 3;
    if (slot % 32 == 0) storeBigEndian(packet, block, 0xFFEE, 2);
    if (slot % 32 == 0) storeBigEndian(packet, block + 2, (content.azimuth + firing * content.step) % 36000, 2);
    const bool second = content.returns == 2 && slot / model.channels % 2 == 1;
    storeBigEndian(packet, at, second ? content.second_counts : content.range_counts, 2);
    packet[at + 2] = static_cast<std::uint8_t>(slot % model.channels);
  }
  return packet;
}
}  // namespace scanloom
