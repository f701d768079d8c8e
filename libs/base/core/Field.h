/** The description of an option: used for loading, checking, the default file and the manual (config/). */
#pragma once
#include <filesystem>
#include <limits>
#include <string>

namespace scanloom
{
/** An interval that includes its ends; the lower one may be excluded. */
struct Bounds
{
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool lowest_excluded = false;
};

constexpr Bounds unbounded() { return {}; }
constexpr Bounds above(double limit) { return {limit, std::numeric_limits<double>::infinity(), true}; }
constexpr Bounds atLeast(double limit) { return {limit, std::numeric_limits<double>::infinity(), false}; }
constexpr Bounds between(double lowest, double highest) { return {lowest, highest, false}; }

/** A text that names files: the same with absolute paths, where relative ones start at `folder`. */
using PathsFrom = std::string (*)(const std::string& text, const std::filesystem::path& folder);

/**
 * An options struct lists its fields once, with the default at the member:
 *
 *   struct LocalMapOptions
 *   {
 *     double keyframe_distance = 4.0;
 *     template <typename Self, typename Visitor>
 *     static void fields(Self& o, Visitor&& visit)
 *     {
 *       visit(o.keyframe_distance, Field{"keyframe_distance", "m", "travel before a new keyframe", above(0)});
 *     }
 *   };
 *
 * Members are bool, int, double or std::string.
 */
struct Field
{
  std::string name;
  std::string unit;     // "m", "s", "deg", "" for a pure number
  std::string meaning;  // one phrase
  Bounds bounds = unbounded();
  PathsFrom paths = nullptr;  // none: its text names no files
};
}  // namespace scanloom
