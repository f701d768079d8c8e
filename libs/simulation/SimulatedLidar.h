/** One spinning lidar: every column cast from where the machine is at that column's instant. */
#pragma once
#include "lidar/OusterEncoder.h"
#include "simulation/Random.h"
#include "simulation/Scenery.h"
#include "simulation/SimulatedClock.h"
#include "simulation/SimulatedLidarOptions.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
/** How strong what comes back is, in multiples of the signal at which half of the returns are lost. */
double signalStrength(double reflectivity, double cosine_incidence, double range, double range_at_ten_percent);

/** Certain to 0.7 of the range where half of the returns are lost, gone at 1.3 of it. */
double chanceOfReturn(double strength);

/** Standard deviation, m. */
double rangeNoise(const RangingOptions&, double strength);

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
  OusterColumn measure(const Scenery&, std::uint64_t column) const;

 private:
  /** What chance does to a beam. */
  struct Luck
  {
    double noise;      // standard normal
    double detection;  // uniform: the return is lost if its chance is not above
    double shade;      // standard normal: of the surface's reflectivity
  };

  static Luck drawLuck(Random&);
  OusterReading readingOf(const std::optional<Hit>&, const Luck&) const;
  double reflectivityOf(Surface) const;

  OusterMetadata metadata_;
  Rigid body_T_sensor_;
  Rigid body_T_lidar_;
  LidarTiming timing_;
  RangingOptions ranging_;
  std::uint64_t seed_, place_;
  double beam_radius_ = 0;                        // m from the axis of rotation to where the beams leave
  double beam_height_ = 0;                        // m
  std::vector<Eigen::Vector3d> beam_directions_;  // at encoder angle 0, in the lidar frame
};
}  // namespace scanloom
