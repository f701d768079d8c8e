/** Velodyne packets put together by hand, and sensors from the files of params/lidars/. */
#pragma once
#include "input/lidar/MetadataKeys.h"
#include "input/lidar/internal/Velodyne.h"

#include <string>
#include <vector>

#include "decoding.h"

namespace scanloom
{
inline std::string velodyneFile(const std::string& model)
{
  return std::string(SCANLOOM_SOURCE_DIR) + "/params/lidars/velodyne_" + model + ".json";
}

/** "vlp16", "hdl32e", "vlp32c", "vls128". */
inline VelodyneMetadata velodyneMetadata(const std::string& model)
{
  return parseVelodyneMetadata(readMetadataText(velodyneFile(model)), model);
}

/** What the packet says; every laser sees `range_counts` units, in a second return `second_counts`. */
struct VelodyneContent
{
  std::uint32_t microseconds = 0;
  std::uint8_t return_mode = 0x37;
  std::uint8_t product_id = 0x22;
  int azimuth = 0;        // of the first group of blocks, 0.01 degrees
  int azimuth_step = 40;  // to the next group
  std::uint16_t range_counts = 500;
  std::uint16_t second_counts = 500;
  std::size_t banks = 1;  // 4 for the VLS-128
};

inline std::vector<std::uint8_t> velodynePacket(const VelodyneContent& content)
{
  std::vector<std::uint8_t> packet(kVelodynePacketBytes, 0);
  const std::uint16_t flags[] = {0xEEFF, 0xDDFF, 0xCCFF, 0xBBFF};
  const std::size_t returns = content.return_mode == 0x39 ? 2 : 1;
  for (std::size_t block = 0; block < 12; ++block)
  {
    const auto group = static_cast<int>(block / (content.banks * returns));
    store(packet, block * 100, flags[block % content.banks]);
    store(packet, block * 100 + 2,
          static_cast<std::uint16_t>((content.azimuth + group * content.azimuth_step) % 36000));
    const bool second = returns == 2 && block % 2 == 1;
    for (std::size_t laser = 0; laser < 32; ++laser)
    {
      store(packet, block * 100 + 4 + 3 * laser, second ? content.second_counts : content.range_counts);
      packet[block * 100 + 6 + 3 * laser] = static_cast<std::uint8_t>(laser);
    }
  }
  store(packet, 1200, content.microseconds);
  packet[1204] = content.return_mode;
  packet[1205] = content.product_id;
  return packet;
}

}  // namespace scanloom
