#pragma once
#include "core/Field.h"
#include "graph/LinearFactor.h"
#include "graph/MarginalFactor.h"
#include "imu/Preintegration.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
struct SmootherOptions
{
  int window = 8;
  int max_iterations = 6;
  double huber = 4.0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.window, Field{"window", "", "states that are estimated together", between(2, 100)});
    visit(o.max_iterations, Field{"max_iterations", "", "steps of the solver per scan at most", between(1, 100)});
    visit(o.huber, Field{"huber", "sigma", "a lidar pose farther off than this counts linearly; 0 never", atLeast(0)});
  }
};

/** How the last optimise() went. */
struct SmootherReport
{
  int iterations = 0;
  double initial_cost = 0;  // half the sum of squared, whitened residuals
  double final_cost = 0;
  bool converged = false;  // else the iterations ran out, or the solver failed
  bool usable = true;      // false: nothing better was found, the states are what they were
  int refused = 0;         // lidar poses that were not finite or absurdly sharp, since the start

  std::string brief() const;  // one line for a person
};

/**
 * The last few states, estimated together from preintegrated IMU motions and lidar poses; what leaves the window stays
 * as a linear prior about the values it had then (doc/smoother.md). One older state, the anchor, may stay with them for
 * lidar poses to be relative to. One thread, and the same input gives the same bits.
 *
 * Covariances are of boxPlus(NavState): translation, rotation (both in the IMU's frame), velocity in the map, gyro
 * bias, accelerometer bias. Poses and information matrices handed in are the body's, in the tangent of boxPlus there.
 */
class FixedLagSmoother
{
 public:
  /** Throws std::invalid_argument if the state is not finite, the covariance not positive definite, or window < 2. */
  FixedLagSmoother(const NavState& initial, const Matrix15d& covariance, const Rigid& body_T_imu, const ImuNoise&,
                   const SmootherOptions&);

  /**
   * Adds the state at motion.to, predicted by the motion; the oldest leaves if there are too many. Throws
   * std::invalid_argument unless the motion starts at the newest state, lasts, and is finite.
   */
  void addState(Preintegration motion);

  /**
   * A lidar pose of the newest state with the lidar's own information, which may be singular. What is not finite, or
   * sharper than a hundredth of a micrometre, is refused and counted: a failed registration must not stop a machine.
   */
  void addPosePrior(const Rigid& map_T_body, const Matrix6d& information);

  /**
   * The newest body as seen from the body at `reference`, an older state that is still there (else
   * std::invalid_argument).
   */
  void addRelativePose(Timestamp reference, const Rigid& reference_T_body, const Matrix6d& information);

  /** Keeps the newest state beyond the window, in place of the anchor before it. */
  void anchorNewest();

  const NavState& anchor() const { return states_[indexOf(anchor_)]; }
  bool hasAnchor() const { return anchor_ != Timestamp::min(); }

  /** The newest state after all states were adjusted. Never throws, never NaN: report() tells how it went. */
  NavState optimise();

  const NavState& newest() const { return states_.back(); }
  const std::deque<NavState>& states() const { return states_; }

  /** Of the newest state given everything before it, at the present values. */
  Matrix15d newestCovariance() const;

  /** Of the newest body as seen from the anchor's, or from the map without an anchor; tangent of boxPlus at it. */
  Matrix6d newestBodyCovariance() const;

  /**
   * The same to first order and at next to no cost, from what newestBodyCovariance() was `before` the newest state had
   * lidar poses, which must be relative to the anchor if there is one.
   */
  Matrix6d bodyCovarianceAfter(const Matrix6d& before) const;

  const SmootherReport& report() const { return report_; }

 private:
  struct LidarPose
  {
    Timestamp stamp;
    std::optional<Timestamp> reference;  // the map where there is none
    Rigid pose;
    Matrix6d information;
  };

  void forget(std::size_t index);
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
  Timestamp anchor_ = Timestamp::min();  // of a state, or none
  std::deque<NavState> states_;          // oldest first, never empty
  std::deque<Preintegration> motions_;   // between neighbours, but for those that a forgotten state lay between
  std::vector<LidarPose> lidar_poses_;   // of states in the window
  MarginalPrior prior_;                  // of states that are still there, the oldest among them
  SmootherReport report_;
};
}  // namespace scanloom
