/** One spinning lidar: its own clock, every column cast from where the machine is at that column's instant. */
#pragma once
#include "core/Time.h"
#include "lidar/OusterEncoder.h"
#include "simulation/Drive.h"
#include "simulation/Random.h"
#include "simulation/World.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
/** No phase lock: each lidar starts at some angle, at some time, and turns at a slightly wrong rate. */
struct LidarTiming
{
  Duration first_stamp{0};    // of the first column, after the recording's start
  double rate_error_ppm = 0;  // positive: columns come later than they should
  std::uint32_t first_frame_id = 0;
  std::uint16_t first_measurement_id = 0;  // begins a packet
};

struct LidarErrors
{
  double range_noise = 0;  // m, standard deviation
  std::uint64_t seed = 0;
  RandomStream stream = RandomStream::LeftLidar;
};

class SimulatedLidar
{
 public:
  SimulatedLidar(OusterMetadata, const Rigid& body_T_sensor, const LidarTiming&, const LidarErrors&);

  const OusterMetadata& metadata() const { return metadata_; }
  const Rigid& bodyTSensor() const { return body_T_sensor_; }

  /** Of the n-th column after the start of a recording at `start`. */
  Timestamp stampOf(Timestamp start, std::uint64_t column) const;

  /** Pure: the same column for the same arguments, in any order and on any thread. */
  OusterColumn measure(const World&, const Drive&, Timestamp start, std::uint64_t column) const;

 private:
  OusterReading measureBeam(const World&, const Rigid& world_T_body, const Ray&, Random&) const;

  OusterMetadata metadata_;
  Rigid body_T_sensor_;
  Rigid body_T_lidar_;
  LidarTiming timing_;
  LidarErrors errors_;
  double beam_radius_ = 0;                        // m from the axis of rotation to where the beams leave
  double beam_height_ = 0;                        // m
  std::vector<Eigen::Vector3d> beam_directions_;  // at encoder angle 0, in the lidar frame
};
}  // namespace scanloom
