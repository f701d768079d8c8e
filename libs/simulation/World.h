/** What the rays of the lidars meet: ground, stems and the machine itself. */
#pragma once
#include "core/Rigid.h"
#include "simulation/Stand.h"

#include <optional>

namespace scanloom
{
enum class Surface
{
  Ground,
  Stem,
  Machine,
};

struct Hit
{
  double range = 0;             // m from the ray's origin
  double cosine_incidence = 0;  // 1 when the ray meets the surface at a right angle
  Surface surface = Surface::Ground;
};

struct World
{
  Ground ground;
  Stand stand;
};

/** The nearest surface within `max_range`; the machine's boxes move with the body. */
std::optional<Hit> cast(const World&, const Rigid& world_T_body, const Ray& ray_in_world, double max_range);

/** The boxes that the machine is made of, in the body frame: cabin and engine, and the boom. */
const std::vector<Eigen::AlignedBox3d>& machineBoxes();
}  // namespace scanloom
