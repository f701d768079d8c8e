/** A rawlog by classes of stock MRPT, not compressed. */
#pragma once
#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
using VelodynePackets = std::vector<std::vector<std::uint8_t>>;

inline mrpt::obs::CObservationVelodyneScan::Ptr velodyneScan(const VelodynePackets& packets,
                                                             mrpt::Clock::time_point received, const std::string& label,
                                                             const mrpt::poses::CPose3D& pose = {})
{
  auto scan = mrpt::obs::CObservationVelodyneScan::Create();
  scan->sensorLabel = label;
  scan->sensorPose = pose;
  scan->timestamp = scan->originalReceivedTimestamp = received;
  for (const auto& packet : packets)
    std::memcpy(static_cast<void*>(&scan->scan_packets.emplace_back()), packet.data(),
                sizeof(mrpt::obs::CObservationVelodyneScan::TVelodyneRawPacket));
  return scan;
}

inline void writeRawlog(const std::filesystem::path& file,
                        const std::vector<mrpt::serialization::CSerializable::Ptr>& objects)
{
  mrpt::io::CFileOutputStream out(file.string());
  auto archive = mrpt::serialization::archiveFrom(out);
  for (const auto& object : objects) archive << *object;
}
}  // namespace scanloom
