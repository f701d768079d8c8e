/** A total station that tracks the machine's prism. */
#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/Scenery.h"
#include "lab/simulation/internal/SimulatedImu.h"

#include <cstdint>
#include <optional>

namespace scanloom
{
struct TotalStationOptions
{
  double noise = 0.003;    // m: standard deviation of each coordinate
  double angle_noise = 1;  // arc seconds: further standard deviation, across the line of sight
  double stamp_offset = 0;
  double lost = 0;
  bool occlusion = true;
  double x = -12;  // m: x of the station in the world frame; the machine starts at (0, 0)

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.stamp_offset, Field{"stamp_offset", "s", "offset of its stamps; positive: too late", between(-1000, 1000)});
    visit(o.lost, Field{"lost", "", "share of the measurements that are lost at random", between(0, 1)});
    visit(o.occlusion, Field{"occlusion", "", "whether what is in the line of sight hides the prism"});
  }
};

struct PrismMeasurement
{
  Timestamp stamp;                                      // of the station's clock
  Eigen::Vector3d station_p = Eigen::Vector3d::Zero();  // m, in the station's frame
};

/** From the world frame into the station's frame, whose origin is far away. */
const Rigid& stationTWorld();

class TotalStation
{
 public:
  TotalStation(const TotalStationOptions&, const Eigen::Vector3d& body_p_prism, const RecordingSpan&,
               std::uint64_t seed);

  /** True time of the n-th measurement, s after the start. */
  double secondsOf(std::uint64_t n) const;

  /** Nothing if the prism is hidden or the measurement is lost. */
  std::optional<PrismMeasurement> measure(const Scenery&, std::uint64_t n) const;

 private:
  bool isHidden(const Scenery&, double t, const Eigen::Vector3d& world_p_prism, std::uint64_t draw) const;
  Eigen::Vector3d eye(const World&) const;  // in the world

  TotalStationOptions options_;
  Eigen::Vector3d body_p_prism_;
  RecordingSpan span_;
  std::uint64_t seed_;
};
}  // namespace scanloom
