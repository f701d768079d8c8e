/** Finds a lost body again. */
#pragma once
#include "base/core/StageTimes.h"
#include "estimation/imu/NavState.h"
#include "estimation/slam/internal/ScanRegistration.h"

#include <optional>
#include <vector>

namespace scanloom
{
/** The state at the last trusted registration, before a faulty IMU could change it. */
struct LastSeen
{
  Rigid local_T_body;  // in the local map
  double score = 0;    // RegistrationResult::score
  Rigid map_T_local;
  ImuBias bias;
};

/** What the IMU alone says about the body. */
struct LostBody
{
  Eigen::Quaterniond local_R_body;
  Eigen::Vector3d up;  // in the body's frame: the mean specific force while it is lost, of any length
  Duration since_trusted;
};

struct FoundBody
{
  RegistrationResult registration;
  Matrix6d covariance;  // of the body in the local map, tangent of boxPlus
};

struct Search;

class Relocalisation
{
 public:
  void remember(const LastSeen& seen) { last_seen_ = seen; }
  const std::optional<LastSeen>& lastSeen() const { return last_seen_; }

  /** When another IMU takes over. */
  void changeBias(const ImuBias&);

  /** When the local map in which the body was seen is given up. */
  void forget() { *this = {}; }

  /**
   * Searches around the place where the body was last seen, as far as a machine can drive since then. All headings are
   * tried, the IMU's first, because the IMU may be wrong. The tilt is the IMU's within 3 deg, or one that agrees better
   * with the accelerometer. The effort for a scan is limited, by the number of starts: the next scan goes on with the
   * starts after them.
   */
  Search search(const NdtMap& local_map, const std::vector<View>& seen_from_body, const LostBody&,
                const ScanRegistrationOptions&) const;

 private:
  std::optional<LastSeen> last_seen_;
  std::size_t next_start_ = 0;  // of the search since the body was last found
};

struct Search
{
  std::optional<FoundBody> found;
  Relocalisation after;  // goes on with the next starts
  StageRuns times;
};
}  // namespace scanloom
