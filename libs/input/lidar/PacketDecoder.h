/** One lidar's packets: from bytes to measurement blocks to points in the body frame. One implementation per brand. */
#pragma once
#include "base/core/Bytes.h"
#include "base/core/ImuSample.h"
#include "base/core/PointCloud.h"
#include "base/core/Rigid.h"
#include "base/core/Time.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** By what packets are put in order, and gaps between them seen. */
enum class Numbering
{
  Ids,     // frame id and measurement id
  Stamps,  // packets have no ids: stamps at regular intervals
};

/** What does not change while a lidar runs: a table with one row per property. */
struct LidarDescription
{
  std::string model;   // as the maker writes it: "OS-0-128"
  std::string serial;  // as the maker writes it; empty if the metadata has none
  int channels = 0;
  int columns_per_frame = 0;  // measurement blocks of a full turn
  int columns_per_packet = 0;
  int first_column = 0;  // azimuth window, inclusive; wraps around 0 if first_column > last_column
  int last_column = 0;
  int returns = 1;                     // points per channel and block at most
  double frame_rate = 0;               // Hz, nominal
  std::uint64_t frame_id_modulus = 0;  // frame ids count modulo this: 65536 or 2^32
  Numbering numbering = Numbering::Ids;
  Duration stamp_modulus{0};       // stamps count modulo this (Velodyne: 1 h); 0: they do not wrap
  Duration fixed_block_period{0};  // where it does not depend on the rotor's speed; 0: it does
  std::uint16_t lidar_port = 0;    // 0 if the metadata has none
  std::uint16_t imu_port = 0;
  Rigid sensor_T_imu;   // the pose of the built-in IMU
  Rigid body_T_sensor;  // the extrinsics folded into the conversion
  std::string clock;    // the sensor's own name for its time source: "TIME_FROM_PTP_1588"; empty if unknown

  Duration blockPeriod() const
  {
    return fixed_block_period > Duration{0} ? fixed_block_period : fromSeconds(1.0 / (frame_rate * columns_per_frame));
  }
};

enum class PacketKind
{
  Lidar,
  Imu,
  Other,      // of this lidar, but without measurements (zone state)
  Malformed,  // neither size nor type is one that this lidar sends
  BadCrc,     // damaged on the way
  Foreign,    // of another sensor, by its serial number or product id
};

/** What a packet says about the whole sensor. */
struct PacketHeader
{
  std::uint32_t frame_id = 0;
  std::optional<std::uint32_t> init_id;  // changes when the sensor starts again
  std::optional<std::uint64_t> serial;
  std::uint8_t alert_flags = 0;
  std::uint8_t thermal_status = 0;        // 0 is normal
  std::uint8_t shot_limiting_status = 0;  // 0 is normal
};

/** The readings of all channels that share one stamp: the unit of batching (paper, section 2.1). */
struct MeasurementBlock
{
  Timestamp stamp;
  std::uint32_t frame_id = 0;
  std::uint16_t measurement_id = 0;  // column of the turn
  std::uint16_t index = 0;           // place in the packet
  bool valid = false;                // the sensor says so, its id lies within the turn and its stamp within 62 bits
};

/**
 * Reads bytes within their bounds and trusts none: what kind() calls Lidar can be given to readBlocks and appendPoints,
 * what it calls Imu to imuSamples, and both to header; they throw std::out_of_range on a packet that is too short.
 * Const and without state: one decoder may serve many threads.
 */
class PacketDecoder
{
 public:
  virtual ~PacketDecoder() = default;

  virtual const LidarDescription& description() const = 0;

  /** By size, type and serial number: the cheap tests. Never BadCrc. */
  virtual PacketKind kindByHeader(Bytes packet) const = 0;

  /** False if the packet's format has a checksum, and it is not that of its bytes: a slow test. */
  virtual bool isIntact(Bytes) const { return true; }

  /** By all tests, where there is one decoder only: else see PacketRouter. */
  PacketKind kind(Bytes packet) const { return isIntact(packet) ? kindByHeader(packet) : PacketKind::BadCrc; }

  virtual PacketHeader header(Bytes packet) const = 0;

  /** Replaces `blocks` by the headers of the packet's blocks, in the packet's order. */
  virtual void readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const = 0;

  /**
   * Appends the valid returns of one block in the body frame: first returns of all channels, then the second ones. `t`
   * is written to every point, plus the channel's own firing time where a brand has one.
   */
  virtual void appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                            PointCloud& points) const = 0;

  /** In the IMU's own frame, SI units, in time order. */
  virtual std::vector<ImuSample> imuSamples(Bytes packet) const = 0;
};
}  // namespace scanloom
