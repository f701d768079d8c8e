/** Vibration by a running engine: harmonics of its frequency and a broad band, in closed form. */
#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/Taylor.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace scanloom
{
/** All assumed. The accelerations are at the body's origin, hence at the lidars and the IMU. */
struct EngineOptions
{
  double acceleration = 0;
  double frequency = 30;   // Hz: firing frequency of the engine
  int harmonics = 4;       // number of lines: 'frequency' and its multiples
  double decay = 0.5;      // amplitude of each multiple as a share of the one before
  double broadband = 0.2;  // root mean square of the acceleration from half of 'frequency' to 'highest_frequency', as a
                           // share of 'acceleration'
  double highest_frequency = 250;  // Hz: end of the broad band
  double sideways = 0.5;           // horizontal accelerations as a share of the vertical ones
  double turn_rate_deg = 0;        // deg/s: amplitude of the body's roll and pitch rate at 'frequency'
  double imu_mount = 0;
  double starts_at = 0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.acceleration,
          Field{"acceleration", "g", "amplitude of the body's vertical acceleration at 'frequency'; 0: no vibration",
                between(0, 5)});
    visit(o.imu_mount,
          Field{"imu_mount", "g",
                "amplitude of the further vertical acceleration of the IMU on its own mount; the lidars do "
                "not see it (assumed)",
                between(0, 5)});
    visit(o.starts_at,
          Field{"starts_at", "s", "when the engine starts, after the start of the recording; 0: it runs before it",
                atLeast(0)});
  }
};

/** Places and angles of a vibrating body beside those at rest, with exact derivatives. */
struct Shake
{
  std::array<Taylor, 3> place;  // m, along the axes of the world
  Taylor pitch, roll;           // rad
};

/** What vibrates: each has other phases. */
enum class VibratingPart : std::uint64_t
{
  Body,
  ImuMount,
};

class EngineVibration
{
 public:
  /** Nothing vibrates. */
  EngineVibration() = default;

  /** Phases and the lines of the broad band depend on the seed. Mounts do not turn. */
  EngineVibration(const EngineOptions&, VibratingPart, std::uint64_t seed);

  bool isStill() const { return lines_[2].empty() && lines_[3].empty(); }

  /** `t` s after the start of the recording. The same before it, unless the engine starts later. */
  Shake at(double t) const;

  /** m/s2, along three axes. */
  Eigen::Vector3d accelerationAt(double t) const;

 private:
  struct Line
  {
    double rate;       // rad/s
    double amplitude;  // m or rad
    double phase;      // rad
  };
  Taylor sumOf(const std::vector<Line>&, double t) const;

  std::array<std::vector<Line>, 5> lines_;  // x, y, z, pitch, roll
  double starts_at_ = 0;                    // s; 0: before the recording
};
}  // namespace scanloom
