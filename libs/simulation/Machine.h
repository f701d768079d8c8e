/** The machine that carries the lidars, as they see it. */
#pragma once
#include "core/Rigid.h"
#include "simulation/Ray.h"

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace scanloom
{
/** The boxes that the machine is made of, in the body frame: cabin and engine, and the boom. */
const std::vector<Eigen::AlignedBox3d>& machineBoxes();

/** Where the ray, given in the world, meets the machine; the boxes move with the body. */
std::optional<Hit> castMachine(const Rigid& world_T_body, const Ray&);
}  // namespace scanloom
