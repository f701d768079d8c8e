/** A spinning lidar: each column is measured from the pose that the machine has at the column's instant. */
#pragma once
#include "lab/simulation/internal/Receiver.h"
#include "lab/simulation/internal/Scenery.h"
#include "lab/simulation/internal/SimulatedClock.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace scanloom
{
/** Number of first returns by surface. */
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
  /** `place`: key of its random numbers. Ranging options of 0 m are taken from the data sheet. */
  SimulatedLidar(OusterMetadata, const Rigid& body_T_sensor, const LidarTiming&, const RangingOptions&,
                 const PrecipitationOptions&, std::uint64_t seed, std::uint64_t place);

  const OusterMetadata& metadata() const { return metadata_; }
  ColumnInstant instantOf(std::uint64_t column) const { return columnInstant(timing_, metadata_, column); }

  /** Whether the column lies in the azimuth window. */
  bool sends(std::uint16_t measurement_id) const;

  /** Pure: may be called in any order and from any thread. Outside the azimuth window the column is not valid. */
  MeasuredColumn measure(const Scenery&, std::uint64_t column) const;

 private:
  OusterMetadata metadata_;
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
