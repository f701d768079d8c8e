#pragma once
#include "base/core/Time.h"

#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * When each cloud was taken, from the first of these that there is:
 * - `times.txt` in the clouds' folder or in the one above: a line per cloud, in s (KITTI, and what `edit` exports).
 *   Of some of the clouds, if their names are numbers: the line of that number, from 0 on.
 * - Their names, if all are numbers of at least nine digits before the point: s, or ns if there are 16 digits or more.
 * - 10 Hz from 0 on.
 * Throws std::runtime_error if times.txt has another number of lines, and for a time that is not after the one before.
 */
struct CloudTimes
{
  std::vector<Timestamp> stamps;
  std::string source;  // for a person: "times.txt", "their names", "none, taken for 10 Hz"
};
CloudTimes cloudTimes(const std::vector<std::filesystem::path>& clouds);
}  // namespace scanloom
