/** The map of an earlier run, in which a drive is localised. */
#pragma once
#include "estimation/slam/PriorMap.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace scanloom
{
struct GivenMap
{
  std::shared_ptr<const PriorMap> map;  // null: there is none
  std::optional<Rigid> map_T_body;      // about where the drive starts; none: anywhere in the map
};

/** The file of keyframes in a result folder of `slam`. Throws UsageError if there is none. */
std::filesystem::path keyframesOf(const std::filesystem::path& folder);

/**
 * Keyframes of a result folder of `slam`. `at`: "x y z yaw pitch roll" (m, deg), or a .tum file of poses in that map,
 * whose last one counts; empty: anywhere. Throws UsageError that says what to do where either cannot be used, and what
 * SimpleMapReader throws.
 */
GivenMap readGivenMap(const std::filesystem::path& folder, const std::string& at, const SlamSettings&);
}  // namespace scanloom
