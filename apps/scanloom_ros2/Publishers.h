#pragma once
#include "input/ros2/Ros2Node.h"
#include "nodeMessage.h"

#include <dds/dds.h>

#include <map>
#include <vector>

namespace scanloom
{
/** Other programs' publishers, as Cyclone discovers them. */
class Publishers
{
 public:
  /** One that has appeared, changed or gone. Those of the `own` participant do not count, nor more than 10,000. */
  void follow(const dds_builtintopic_endpoint_t&, const dds_sample_info_t&, const dds_guid_t& own);

  /** By name and type; a topic offers what all of its publishers offer. */
  std::vector<Ros2Publication> publications() const;

 private:
  std::map<Guid, Ros2Publication> publishers_;  // one publisher each
};
}  // namespace scanloom
