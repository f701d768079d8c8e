#include "lab/simulation/internal/Machine.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
MachineParts partsOf(MachineParts parts)
{
  const auto ofBox = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    return MachineParts{parts.kind, {{low, high}}, false};
  };
  if (parts.kind == "harvester") return parts;
  if (parts.kind == "car") return ofBox({-2.2, -0.9, 0.2}, {2.2, 0.9, 1.5});
  if (parts.kind == "robot") return ofBox({-0.5, -0.35, 0.1}, {0.5, 0.35, 0.7});
  if (parts.kind == "person") return ofBox({-0.15, -0.25, 0}, {0.15, 0.25, 1.75});
  throw std::invalid_argument(
      fmt::format("[simulated_machine] kind = '{}': must be harvester, car, robot or person", parts.kind));
}
}  // namespace scanloom
