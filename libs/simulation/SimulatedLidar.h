/** One spinning lidar: every column cast from where the machine is at that column's instant. */
#pragma once
#include "simulation/Receiver.h"
#include "simulation/Scenery.h"
#include "simulation/SimulatedClock.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace scanloom
{
/** What the first returns of many beams came from. */
struct ReturnCounts
{
  std::array<std::uint64_t, kSurfaces> of_surface{};
  std::uint64_t none = 0;

  void add(const std::optional<Surface>& surface)
  {
    if (surface)
      ++of_surface[static_cast<std::size_t>(*surface)];
    else
      ++none;
  }
  void add(const ReturnCounts& other)
  {
    for (std::size_t i = 0; i < of_surface.size(); ++i) of_surface[i] += other.of_surface[i];
    none += other.none;
  }
};

struct MeasuredColumn
{
  OusterColumn column;
  ReturnCounts returns;
};

class SimulatedLidar
{
 public:
  /** `place` sets its random numbers apart from those of all others. Ranges of 0 are taken from the data sheet. */
  SimulatedLidar(OusterMetadata, const Rigid& body_T_sensor, const LidarTiming&, const RangingOptions&,
                 std::uint64_t seed, std::uint64_t place);

  const OusterMetadata& metadata() const { return metadata_; }
  const Rigid& bodyTSensor() const { return body_T_sensor_; }
  const LidarTiming& timing() const { return timing_; }
  ColumnInstant instantOf(std::uint64_t column) const { return columnInstant(timing_, metadata_, column); }

  /** Within the azimuth window that the metadata give. */
  bool sends(std::uint16_t measurement_id) const;

  /** Pure: the same column for the same arguments, in any order and on any thread. Not valid outside the window. */
  MeasuredColumn measure(const Scenery&, std::uint64_t column) const;

 private:
  OusterMetadata metadata_;
  Rigid body_T_sensor_;
  Rigid body_T_lidar_;
  LidarTiming timing_;
  std::uint64_t seed_, place_;
  bool two_returns_;
  double beam_radius_ = 0;  // m from the axis of rotation to where the beams leave
  double beam_height_ = 0;  // m
  Receiver receiver_;
  std::vector<Eigen::Vector3d> beam_directions_;  // at encoder angle 0, in the lidar frame
};
}  // namespace scanloom
