/** Rawlogs of stock MRPT that hold packets of lidars (CObservationVelodyneScan), as plain values. */
#pragma once
#include "base/core/ImuSample.h"
#include "base/core/Rigid.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace scanloom
{
/** The packets of a turn, as rawlog-grabber's CVelodyneScanner wrote them. */
struct VelodyneTurn
{
  struct Packet
  {
    Timestamp received;  // by the computer: of the first one as recorded, of the others by the lidar's clock after it
    std::vector<std::uint8_t> bytes;
  };
  std::vector<Packet> packets;  // one or more
};

/** What a sensor of a rawlog measured. */
struct RawlogMeasurement
{
  std::string label;
  Rigid body_T_sensor;
  std::variant<VelodyneTurn, ImuSample> value;
};

/** Turns and IMU samples in the file's order; what else it holds is passed over. */
class PacketRawlog
{
 public:
  /** Throws std::runtime_error with the file's name if it can't be opened. */
  explicit PacketRawlog(const std::filesystem::path&);
  ~PacketRawlog();

  /** False at the end. */
  bool next(RawlogMeasurement&);

  /** Why reading ended before the file did; empty if it did not. */
  const std::string& damage() const;

  /** Compressed bytes. */
  std::uint64_t bytesRead() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/** Whether these are the first bytes of a serialised object of MRPT: of an unpacked rawlog. */
bool beginsLikeRawlog(std::string_view bytes);

/** Whether it is a rawlog with packets among its first observations, and no point cloud before them. False for a file
 * that can't be read. */
bool isRawlogOfPackets(const std::filesystem::path&);
}  // namespace scanloom
