/** What is remembered from one scan to the next. */
#pragma once
#include "estimation/slam/internal/Assessment.h"
#include "estimation/slam/internal/LocalMap.h"
#include "estimation/slam/internal/Relocalisation.h"
#include "estimation/slam/internal/SharedAttitudeNoise.h"
#include "estimation/slam/internal/SmootherWindow.h"

#include <optional>

namespace scanloom
{
/** The last pose that was not LOST. */
struct LastGood
{
  Timestamp stamp;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, in the map
  Matrix6d since_start = Matrix6d::Zero();             // as SmootherWindow::before; without scaleError()
};

struct TrackerState
{
  SmootherWindow window;
  LocalMap local_map;  // rigid, in a frame of its own
  TrustHistory trust{};
  Relocalisation relocalisation{};
  SharedAttitudeNoise shared_attitude_noise{};
  std::optional<Timestamp> resting_since{};  // lost, and no longer carried by the IMU
  int scans_seen = 0;  // in a row that have points: the first after a silence may be a single packet
  LastGood last_good{};
};
}  // namespace scanloom
