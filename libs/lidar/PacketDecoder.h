/** One lidar's packets: from bytes to measurement blocks to points in the body frame. One implementation per brand. */
#pragma once
#include "core/Bytes.h"
#include "core/ImuSample.h"
#include "core/PointCloud.h"
#include "core/Rigid.h"
#include "core/Time.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** How a lidar's packets are put in order and missed. */
enum class Numbering
{
  Ids,     // by frame id and measurement id
  Stamps,  // packets bear no ids: by their stamps alone, at the packets' regular distance
};

/** What does not change while a lidar runs. */
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
  Duration fixed_block_period{0};  // where it does not depend on the rotor's speed; 0: a turn's share
  std::uint16_t lidar_port = 0;        // 0 if the metadata has none
  std::uint16_t imu_port = 0;
  Rigid sensor_T_imu;   // the pose of the built-in IMU
  Rigid body_T_sensor;  // the extrinsics folded into the conversion
  std::string clock;    // the sensor's own name for its time source: "TIME_FROM_PTP_1588"; empty if unknown

  Duration blockPeriod() const
  {
    return fixed_block_period > Duration{0} ? fixed_block_period
                                            : fromSeconds(1.0 / (frame_rate * columns_per_frame));
  }
};

enum class PacketKind
{
  Lidar,
  Imu,
  Other,      // this lidar's, but of no use here (zone state)
  Malformed,  // this lidar's port, but the size or the type fits nothing it sends
  BadCrc,
  Foreign,  // another sensor's: serial or init id of somebody else
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
  bool valid = false;                // says the sensor; and its id lies within the turn, its stamp within 62 bits
};

/**
 * Reads bounded bytes and never trusts them: what kind() calls Lidar can be given to readBlocks and appendPoints, what
 * it calls Imu to imuSamples, and both to header; they throw std::out_of_range on anything too short for them. Const
 * and free of state: one decoder may serve many threads.
 */
class PacketDecoder
{
 public:
  virtual ~PacketDecoder() = default;

  virtual const LidarDescription& description() const = 0;

  /** Checked once per packet: size, type, serial, CRC where the profile has one. */
  virtual PacketKind kind(Bytes packet) const = 0;
  virtual PacketHeader header(Bytes packet) const = 0;

  /** Replaces `blocks` by the headers of the packet's blocks, in the packet's order. */
  virtual void readBlocks(Bytes packet, std::vector<MeasurementBlock>& blocks) const = 0;

  /**
   * Appends the valid returns of one block, converted into the body frame; `t` is written to every point
   * (plus the channel's own firing offset where a brand has one). First returns of all channels, then the second ones.
   */
  virtual void appendPoints(Bytes packet, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                            PointCloud& points) const = 0;

  /** In the IMU's own frame, SI units, in time order. */
  virtual std::vector<ImuSample> imuSamples(Bytes packet) const = 0;
};
}  // namespace scanloom
