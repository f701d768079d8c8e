#pragma once
#include "base/core/Time.h"

#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * When each cloud was taken, from the first of these that there is:
 * - `times.txt` or `timestamps.txt` in the clouds' folder or in the one above: a line per cloud, in s or as a date
 * (KITTI, and what `edit` exports). Of some of the clouds, if their names are numbers: the line of that number, from 0
 * on.
 * - Their names, if all are numbers of at least nine digits before the point: s with decimals, or integers in s, ms, us
 *   or ns, in which they have the pace of a lidar. Numbers that only count are no times.
 * - 10 Hz from 0 on.
 * Throws std::runtime_error if times.txt has another number of lines, for names that are times in no unit, and for a
 * time that is not after the one before.
 */
struct CloudTimes
{
  std::vector<Timestamp> stamps;
  std::string source;  // for a person: "times.txt", "the clouds' names, in us", "none, taken for 10 Hz"
};
CloudTimes cloudTimes(const std::vector<std::filesystem::path>& clouds);
}  // namespace scanloom
