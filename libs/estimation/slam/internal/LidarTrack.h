#pragma once
#include "base/core/Rigid.h"

#include <optional>

namespace scanloom
{
/** Where the last two scans in a row saw the body, by registration alone. */
class LidarTrack
{
 public:
  void add(const Rigid& local_T_body);
  /** After a scan without such a registration. */
  void clear();

  /** Whether this pose of the next scan goes on with the last step, as no pose at another place does that looks alike.
   */
  bool goesOnTo(const Rigid& local_T_body) const;

 private:
  std::optional<Rigid> last_, last_step_;
};
}  // namespace scanloom
