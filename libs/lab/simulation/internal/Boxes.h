/** Boxes that rays meet, found by Embree. */
#pragma once
#include "lab/simulation/internal/Solids.h"

#include <memory>
#include <optional>
#include <vector>

struct RTCSceneTy;

namespace scanloom
{
class Boxes
{
 public:
  /** Boxes in the world, m. Throws std::runtime_error with what Embree says. */
  explicit Boxes(std::vector<OrientedBox>);

  /** The nearest box within `max_range`. Pure; may be called from any thread. */
  std::optional<Contact> cast(const Ray&, double max_range) const;

 private:
  std::shared_ptr<const std::vector<OrientedBox>> boxes_;
  std::shared_ptr<RTCSceneTy> scene_;  // none without boxes
};
}  // namespace scanloom
