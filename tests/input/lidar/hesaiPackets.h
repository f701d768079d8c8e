/** Hesai packets put together by hand, and sensors that send them. */
#pragma once
#include "input/lidar/internal/Hesai.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "decoding.h"

namespace scanloom
{
/** The text of a metadata file, with angles of their own for all channels; these are no real unit's. */
inline std::string hesaiText(const HesaiModel& model, int returns = 1)
{
  std::vector<double> vertical, offset;
  for (int i = 0; i < model.channels; ++i)
  {
    vertical.push_back(15 - 40.0 * i / model.channels);
    offset.push_back(2.1 * (i % 3 - 1));
  }
  return nlohmann::json{{"lidar", "hesai"},
                        {"model", model.name},
                        {"returns", returns},
                        {"vertical_angles_deg", vertical},
                        {"azimuth_offsets_deg", offset}}
      .dump();
}

inline std::unique_ptr<PacketDecoder> hesaiDecoder(const HesaiModel& model, int returns = 1)
{
  return makeHesai(parseHesaiMetadata(hesaiText(model, returns), "its file"), Rigid::identity());
}

/** What the packet says; every channel sees `range_counts` of 4 mm, in a second return `second_counts`. */
struct HesaiContent
{
  int year = 2023, month = 3, day = 1, hour = 12, minute = 30, second = 15;
  std::uint32_t microseconds = 500'000;
  std::uint8_t return_mode = 0x37;
  int azimuth = 0, azimuth_step = 20;  // of the first firing, and to the next one; 0.01 degrees
  std::uint16_t range_counts = 500, second_counts = 700;
};

inline std::vector<std::uint8_t> hesaiPacket(const HesaiModel& model, const HesaiContent& content)
{
  std::vector<std::uint8_t> packet(model.packetBytes(), 0);
  if (model.header_bytes != 0) store(packet, 0, std::uint16_t{0xFFEE});
  const auto channels = static_cast<std::uint8_t>(model.channels), blocks = static_cast<std::uint8_t>(model.firings);
  const std::vector<std::uint8_t> short_header{0xEE, 0xFF, channels, blocks, 0, 4, 0, 0};
  const std::vector<std::uint8_t> long_header{
      0xEE, 0xFF, model.protocol_major, model.protocol_minor, 0, 0, channels, blocks, 0, 4, 1, 0};
  const auto& header = model.header_bytes == 8 ? short_header : long_header;
  if (model.header_bytes != 0) std::copy(header.begin(), header.end(), packet.begin());
  const int returns = content.return_mode < 0x39 ? 1 : 2;
  for (int block = 0; block < model.firings; ++block)
  {
    const std::size_t at = model.header_bytes + static_cast<std::size_t>(block) * model.blockBytes();
    if (model.azimuth_at != 0) store(packet, at, std::uint16_t{0xEEFF});
    const int azimuth = content.azimuth + block / returns * content.azimuth_step;
    store(packet, at + model.azimuth_at, static_cast<std::uint16_t>(azimuth % 36000));
    for (std::size_t i = 0; i < channels; ++i)
    {
      const std::size_t reading = at + model.azimuth_at + 2 + i * model.reading_bytes;
      store(packet, reading, returns == 2 && block % 2 == 1 ? content.second_counts : content.range_counts);
      packet[reading + 2] = static_cast<std::uint8_t>(i);
    }
  }
  const std::size_t tail = model.tailAt();
  packet[tail + model.tail.return_mode] = content.return_mode;
  const int date[] = {content.year - 1900, content.month, content.day, content.hour, content.minute, content.second};
  for (std::size_t i = 0; i < 6; ++i) packet[tail + model.tail.date + i] = static_cast<std::uint8_t>(date[i]);
  store(packet, tail + model.tail.microseconds, content.microseconds);
  return packet;
}
}  // namespace scanloom
