#pragma once
#include "estimation/graph/internal/LinearFactor.h"
#include "estimation/graph/internal/MarginalFactor.h"
#include "estimation/imu/Preintegration.h"

#include <deque>
#include <optional>
#include <vector>

namespace scanloom
{
struct SmootherOptions
{
  int window = 8;          // number of states that are estimated together
  int max_iterations = 6;  // of the solver per scan
  double huber =
      4.0;  // sigma: a lidar pose farther than this from the estimate is weighted down (Huber loss); 0: never
};

/** How the last optimise() went. */
struct SmootherReport
{
  int iterations = 0;
  double initial_cost = 0;  // half the sum of squared, whitened residuals
  double final_cost = 0;
  bool converged = false;  // false: the iterations ran out, or the solver failed
  bool usable = true;      // false: the solver found nothing better, the states are unchanged
  int refused = 0;         // lidar poses since the start (see addPosePrior)
};

/**
 * The last few states, estimated together from preintegrated IMU motions and lidar poses. A state that leaves the
 * window is replaced by a linear prior at the values it had then (doc/smoother.md). One older state, the anchor, may
 * stay, so that lidar poses can be relative to it. One thread; the same input gives the same bits.
 *
 * Covariances are of boxPlus(NavState): translation, rotation (both in the IMU's frame), velocity in the map, gyro
 * bias, accelerometer bias. Poses and information matrices passed in are those of the body, in the tangent of boxPlus.
 */
class FixedLagSmoother
{
 public:
  /** Throws std::invalid_argument if the state is not finite, the covariance not positive definite, or window < 2. */
  FixedLagSmoother(const NavState& initial, const Matrix15d& covariance, const Rigid& body_T_imu, const ImuNoise&,
                   const SmootherOptions&);

  /**
   * Adds the state at motion.to, predicted by the motion; the oldest leaves if there are too many. Throws
   * std::invalid_argument unless the motion starts at the newest state, ends later, and is finite.
   */
  void addState(Preintegration motion);

  /**
   * A lidar pose of the newest state with the lidar's own information, which may be singular. A pose that is not
   * finite, or more accurate than a hundredth of a micrometre, is refused and counted: a failed registration must not
   * stop a machine.
   */
  void addPosePrior(const Rigid& map_T_body, const Matrix6d& information);

  /** The pose of the newest body relative to the body at `reference`; std::invalid_argument if no older state of that
   * stamp is in the window. */
  void addRelativePose(Timestamp reference, const Rigid& reference_T_body, const Matrix6d& information);

  /** The newest state becomes the anchor, instead of the one before: it is kept when the window moves on. */
  void anchorNewest();

  /**
   * From now on, lidar poses are measured from a place that is an unknown step away from the anchor's body. `step`: its
   * covariance (m², rad²), in the tangent of boxPlus at that body. Poses measured before stay relative to the old place
   * and are linear from now on. Throws std::invalid_argument without an anchor older than the newest state.
   */
  void loosenAnchor(const Matrix6d& step);

  const NavState& anchor() const { return states_[indexOf(*anchor_)]; }
  Rigid anchorBody() const { return bodyAt(anchor()); }
  bool hasAnchor() const { return anchor_.has_value(); }

  /** The newest state after all states were adjusted. Never throws, never NaN: report() says how it went. */
  NavState optimise();

  const NavState& newest() const { return states_.back(); }
  Rigid newestBody() const { return bodyAt(newest()); }
  const std::deque<NavState>& states() const { return states_; }

  /** Covariance of the newest state given all measurements so far, linearised at the present values. */
  Matrix15d newestCovariance() const;

  /** Covariance of the newest body's pose relative to the anchor's, or to the map without an anchor; tangent of boxPlus
   * at it. */
  Matrix6d newestBodyCovariance() const;

  /**
   * The same to first order, at little cost: from newestBodyCovariance() as it was `before` the newest state had lidar
   * poses. These must be relative to the anchor if there is one.
   */
  Matrix6d bodyCovarianceAfter(const Matrix6d& before) const;

  const SmootherReport& report() const { return report_; }
  const Rigid& body_T_imu() const { return body_T_imu_; }
  const ImuNoise& noise() const { return noise_; }
  const SmootherOptions& options() const { return options_; }

 private:
  struct LidarPose
  {
    Timestamp stamp;
    std::optional<Timestamp> reference;  // the map where there is none
    Rigid pose;
    Matrix6d information;
  };

  void forget(std::size_t index);
  std::vector<LinearFactor> linearFactorsOf(std::size_t index) const;
  void replacePrior(LinearFactor);
  void dropFactorsOf(Timestamp state);
  void add(const LidarPose&);
  Matrix6d informationOf(const LidarPose&) const;
  Rigid bodyAt(const NavState&) const;
  std::vector<Factor> factors() const;
  std::vector<LinearFactor> linearFactors(std::vector<StateBlocks>& window) const;
  std::vector<StateBlocks> blocks() const;
  std::size_t indexOf(Timestamp) const;

  Rigid body_T_imu_;
  ImuNoise noise_;
  SmootherOptions options_;
  std::optional<Timestamp> anchor_;     // its stamp
  std::deque<NavState> states_;         // oldest first, never empty
  std::deque<Preintegration> motions_;  // between neighbouring states, except across a state that has left
  std::vector<LidarPose> lidar_poses_;  // of states in the window
  MarginalPrior prior_;                 // about states of the window, the oldest among them
  SmootherReport report_;
};
}  // namespace scanloom
