/** What people build, as boxes that stand still: house fronts, parked cars, halls, car parks, corridors, stairs; and
 * hedges. */
#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/Drive.h"
#include "lab/simulation/internal/Solids.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanloom
{
struct BuildingOptions
{
  std::string kind = "none";

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.kind, Field{"kind", "",
                        "what stands around the machine's path, with assumed sizes: street (house fronts, parked cars, "
                        "lamp posts), hall (walls, roof, pillars, machines), car_park (pillars, low ceiling, parked "
                        "cars), hedge (one, 40 m off the path), corridor (walls, doors), stairs (a corridor whose "
                        "floor has steps); none: nothing"});
  }
};

/** The boxes, in the world, along the drive's path. Throws std::invalid_argument for an unknown kind. */
std::vector<OrientedBox> build(const BuildingOptions&, const Drive&, std::uint64_t seed);
}  // namespace scanloom
