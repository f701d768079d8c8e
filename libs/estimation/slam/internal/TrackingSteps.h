/** What each step of Tracker::step() finds out about a scan, in their order. */
#pragma once
#include "base/core/Keyframe.h"
#include "base/core/StageTimes.h"
#include "estimation/ndt/Registration.h"
#include "estimation/ndt/View.h"
#include "estimation/slam/internal/InnovationMonitor.h"
#include "estimation/slam/internal/LocalMap.h"
#include "estimation/slam/internal/SharedAttitudeNoise.h"
#include "estimation/slam/internal/SmootherWindow.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** The state at the scan's end by the IMU alone. */
struct Prediction
{
  SmootherWindow window;  // its newest state is the one at the scan's end
  Rigid map_T_body;
  Matrix6d covariance;  // see FixedLagSmoother::newestBodyCovariance()
  StageRuns times;
};

struct DeskewedScan
{
  Timestamp stamp;  // its end
  bool complete = true;
  PointCloud cloud;         // in the body frame at `stamp`
  std::vector<View> views;  // the same points, by lidar
  int in_a_row = 0;         // scans with points, this one included
  StageRuns times;
};

/** The scan's pose in the local map. */
struct GatedRegistration
{
  std::optional<RegistrationResult> result;  // none for the first scan of a map, or one without points
  double mahalanobis = 0;                    // distance from the prediction in standard deviations
  bool usable = false;                       // by its outcome
  bool trusted = false;                      // by this distance, too
  StageRuns times;
};

/** The registration as the smoother takes it, and what the next ones are weighed by. */
struct Measurement
{
  SmootherWindow window;
  SharedAttitudeNoise shared_noise;
  InnovationMonitor contradiction;
};

/** The body at the scan's end. */
struct BodyEstimate
{
  SmootherWindow window;  // with it as the newest state
  Rigid map_T_body;
  Matrix6d covariance = Matrix6d::Zero();              // see StateEstimate
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, of the IMU, in the map frame
};

struct UpdatedMap
{
  LocalMap local_map;
  SmootherWindow window;                            // its anchor, as a new keyframe moves the map
  std::optional<Keyframe> keyframe;                 // the one that was added
  Matrix6d keyframe_covariance = Matrix6d::Zero();  // see StateEstimate
  bool restarted = false;                           // the map begins with it
  StageRuns times;
};

/** Where a keyframe joins the local map. */
struct KeyframePose
{
  Rigid local_T_body;
  Matrix6d covariance;  // in the map, tangent of boxPlus
};
}  // namespace scanloom
