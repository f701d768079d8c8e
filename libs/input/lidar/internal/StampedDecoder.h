/** Lidars whose packets carry a stamp, but no column numbers (Velodyne, Hesai, Robosense): all that the brands share.
 */
#pragma once
#include "base/core/Angle.h"
#include "input/lidar/MetadataKeys.h"
#include "input/lidar/PacketDecoder.h"
#include "input/lidar/internal/AngleTable.h"
#include "input/lidar/internal/BeamTable.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace scanloom
{
constexpr int kTurn = 36000;  // azimuths of all these brands count hundredths of a degree, clockwise seen from above
constexpr double kRadiansPerCount = 2 * M_PI / kTurn;

/** The first columns of a brand's table of models. */
struct StampedModel
{
  std::string_view name;  // as in metadata: "VLP-16"
  int channels = 0;
  int firings =
      0;  // in a packet with one return: each fires all channels once. With two returns there are half as many
  Duration period;  // from one firing to the next
};

/** What a metadata file says, beside the model: the sensor's settings, and its angles by channel. */
struct StampedSettings
{
  std::string serial;                                    // for reports only: packets have none
  double rpm = 600;                                      // as set in the sensor
  int returns = 1;                                       // as set in the sensor: 1 or 2
  std::uint16_t port = 0;                                // of lidar packets
  double first_azimuth_deg = 0, last_azimuth_deg = 360;  // field of view as set in the sensor, clockwise; may wrap
  AngleTable angles;  // above the plane of rotation; clockwise, added to the azimuth in the packet
};

template <typename Model>
struct StampedMetadata : StampedSettings
{
  const Model* model = nullptr;  // a row of the brand's table
};

/** The row that the key "model" names. Throws std::invalid_argument with the names of all. */
std::size_t rowOfModel(const MetadataKeys&, const std::vector<std::string_view>& names);

/** `file_name`: angles in a csv file lie beside it. Throws std::invalid_argument with file, key and what is expected.
 */
StampedSettings readSettings(const MetadataKeys&, const std::string& file_name, int channels, std::uint16_t port);

template <typename Models>
StampedMetadata<typename Models::value_type> readMetadata(const MetadataKeys& keys, const std::string& file_name,
                                                          const Models& models, std::uint16_t default_port)
{
  std::vector<std::string_view> names;
  for (const StampedModel& model : models) names.push_back(model.name);
  const auto& model = models[rowOfModel(keys, names)];
  return {readSettings(keys, file_name, model.channels, default_port), &model};
}

/** `stamp_modulus` and `clock` as in LidarDescription. */
LidarDescription describe(const StampedModel&, const StampedSettings&, const Rigid& body_T_sensor,
                          Duration stamp_modulus, const char* clock);

int columnOf(double azimuth, int columns);

/** The ring of each channel: 0 is the topmost beam. Channels of most lidars count or fire in an order of their own. */
std::vector<std::uint8_t> ringsFromTheTop(const std::vector<double>& vertical_deg);

/** When channels fire, in ns after a time that the brand defines, by channel. */
struct ShotTimes
{
  const std::int32_t* of_channel = nullptr;
  std::int32_t first = 0;  // the smallest
};

template <std::size_t kChannels>
constexpr ShotTimes shotTimes(const std::array<std::int32_t, kChannels>& times)
{
  ShotTimes shots{times.data(), times[0]};
  for (const std::int32_t time : times) shots.first = time < shots.first ? time : shots.first;
  return shots;
}

/** Time and direction of one firing of all channels. */
struct Firing
{
  Duration after_stamp{
      0};              // of its first shot after the packet's stamp; negative where packets are stamped at their end
  double azimuth = 0;  // of its first shot, 0.01 degrees, 0 to 36000
  double rate = 0;     // by which azimuths of later shots grow, 0.01 degrees per ns; 0: all are those of the first
  ShotTimes shots;
  bool valid = false;
};

struct Reading
{
  std::uint16_t counts = 0;  // of the packet's unit of range; 0: no return
  std::uint8_t reflectivity = 0;
};

/**
 * The decoder of a brand. A measurement block is a firing of all channels, stamped with its first shot; the others
 * follow, each with its own time in PointCloud::t. Packets are put in order by their stamps (Numbering::Stamps).
 * frame_id is 0; measurement_id is the azimuth as a column of columns_per_frame: two blocks half a column apart may
 * have the same.
 *
 * `Packet` is the brand's view of a packet's bytes:
 *
 *   using Metadata = a StampedMetadata<Model>
 *   static constexpr Duration kStampModulus; static constexpr const char* kClock      as in LidarDescription
 *   static PacketKind kind(Bytes, const Metadata&)                                    PacketDecoder::kindByHeader
 *   static double encoderAngle(double azimuth)              rad, counter-clockwise from the sensor's x axis
 *   static Eigen::Vector3d origin(const Metadata&, i)       of channel i's ray, in the turning frame (BeamTable.h)
 *   Packet(Bytes, const Metadata&)                          throws std::out_of_range for too few bytes
 *   std::optional<Timestamp> stamp()                        nothing if there is no such time
 *   int returns(), double unitMm()
 *   std::size_t firings(), Firing firing(i)
 *   Reading reading(firing, channel, which)                 `which` return: 0, or 1 in packets with two
 */
template <typename Packet>
class StampedDecoder final : public PacketDecoder
{
 public:
  using Metadata = typename Packet::Metadata;

  StampedDecoder(const Metadata& metadata, const Rigid& body_T_sensor)
    : metadata_(metadata),
      description_(describe(*metadata.model, metadata, body_T_sensor, Packet::kStampModulus, Packet::kClock)),
      beams_(beamsOf(metadata), body_T_sensor),
      rings_(ringsFromTheTop(metadata.angles.vertical))
  {
  }

  const LidarDescription& description() const override { return description_; }
  PacketKind kindByHeader(Bytes packet) const override { return Packet::kind(packet, metadata_); }
  PacketHeader header(Bytes) const override { return {}; }
  std::vector<ImuSample> imuSamples(Bytes) const override { return {}; }

  void readBlocks(Bytes bytes, std::vector<MeasurementBlock>& blocks) const override
  {
    const Packet packet(bytes, metadata_);
    const std::optional<Timestamp> stamp = packet.stamp();
    blocks.assign(packet.firings(), {});
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
      const Firing firing = packet.firing(i);
      if (stamp) blocks[i].stamp = wrapped(*stamp + firing.after_stamp);
      blocks[i].measurement_id = column(firing);
      blocks[i].index = static_cast<std::uint16_t>(i);
      blocks[i].valid = firing.valid && stamp.has_value();
    }
  }

  void appendPoints(Bytes bytes, std::size_t block_index, std::int32_t t, std::uint8_t sensor_id,
                    PointCloud& points) const override
  {
    const Packet packet(bytes, metadata_);
    if (block_index >= packet.firings()) throw std::out_of_range("appendPoints: the packet has no such block");
    const Firing firing = packet.firing(block_index);
    if (!firing.valid || !packet.stamp()) return;

    const double th = Packet::encoderAngle(firing.azimuth), rate = -firing.rate * kRadiansPerCount;
    const double cos_th = std::cos(th), sin_th = std::sin(th), unit_mm = packet.unitMm();
    const std::uint16_t column = this->column(firing);
    const PointRoom to = points.room(2 * rings_.size());
    std::size_t n = 0;
    const auto write = [&](std::size_t channel, Reading reading)
    {
      const std::int32_t shot = firing.shots.of_channel[channel] - firing.shots.first;
      // A firing turns by less than 0.015 rad: two terms of cosine and sine are right to 6e-7.
      const double turned = rate * shot, shrunk = 1 - 0.5 * turned * turned;
      const double range_mm = reading.counts * unit_mm;
      const Eigen::Vector3f point =
          beams_.project(static_cast<Eigen::Index>(channel), static_cast<float>(cos_th * shrunk - sin_th * turned),
                         static_cast<float>(sin_th * shrunk + cos_th * turned), static_cast<float>(range_mm));
      to.x[n] = point.x();
      to.y[n] = point.y();
      to.z[n] = point.z();
      to.intensity[n] = reading.reflectivity;
      to.t[n] = t + shot;
      to.ring[n] = rings_[channel];
      to.column[n] = column;
      to.sensor_id[n] = sensor_id;
      to.range[n] = static_cast<std::uint32_t>(range_mm + 0.5);
      to.signal[n] = to.near_ir[n] = 0;
      ++n;
    };
    for (std::size_t channel = 0; channel < rings_.size(); ++channel)
      if (const Reading first = packet.reading(block_index, channel, 0); first.counts > 0) write(channel, first);
    for (std::size_t channel = 0; packet.returns() == 2 && channel < rings_.size(); ++channel)
    {
      const Reading second = packet.reading(block_index, channel, 1);
      // A sensor that saw one thing reports it twice.
      if (second.counts > 0 && second.counts != packet.reading(block_index, channel, 0).counts) write(channel, second);
    }
    points.grow(n);
  }

 private:
  static std::vector<Beam> beamsOf(const Metadata& metadata)
  {
    std::vector<Beam> beams;
    for (std::size_t i = 0; i < metadata.angles.vertical.size(); ++i)
      beams.push_back(Beam{-metadata.angles.azimuth[i] * kDegree, metadata.angles.vertical[i] * kDegree,
                           Packet::origin(metadata, i), 0});
    return beams;
  }

  /** Some counters go on past their modulus, and the first shot may lie before the packet's stamp. */
  static Timestamp wrapped(Timestamp stamp)
  {
    if constexpr (Packet::kStampModulus > Duration{0})
      return Timestamp{(stamp.time_since_epoch() + Packet::kStampModulus) % Packet::kStampModulus};
    return stamp;
  }

  std::uint16_t column(const Firing& firing) const
  {
    return static_cast<std::uint16_t>(columnOf(firing.azimuth, description_.columns_per_frame));
  }

  Metadata metadata_;
  LidarDescription description_;
  BeamTable beams_;
  std::vector<std::uint8_t> rings_;  // by channel
};
}  // namespace scanloom
