#include "base/formats/internal/FloatsReader.h"

#include "base/core/Statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
constexpr std::size_t kOfKitti = 4;  // x y z intensity
constexpr std::size_t kLeast = 3, kMost = 7;
constexpr std::size_t kLookedAt = 40'000;  // floats
constexpr std::size_t kEnough = 50;        // points, for a judgement

std::vector<float> firstFloats(Bytes file)
{
  std::vector<float> floats(std::min(file.size() / sizeof(float), kLookedAt));
  for (std::size_t i = 0; i < floats.size(); ++i) floats[i] = load<float>(file, i * sizeof(float));
  return floats;
}

/** The median distance of numbers `step` apart: least where like is compared with like, x with x and z with z. */
double medianDistance(const std::vector<float>& floats, std::size_t step)
{
  std::vector<float> distances;
  for (std::size_t i = step; i < floats.size(); ++i)
    if (const float d = std::abs(floats[i] - floats[i - step]); std::isfinite(d)) distances.push_back(d);
  return distances.empty() ? 0 : upperMedian(std::move(distances));
}

/**
 * KITTI's four unless another number that divides the file fits better; 0 if none divides it. A multiple of the right
 * number fits as well as that: here only 6, of 3, which is tried first.
 */
std::size_t floatsOfPoint(Bytes file, const std::vector<float>& floats)
{
  const auto divides = [&](std::size_t count) { return file.size() % (count * sizeof(float)) == 0; };
  if (floats.size() < kEnough * kOfKitti && divides(kOfKitti)) return kOfKitti;
  std::size_t best = kOfKitti;
  double least = divides(kOfKitti) ? medianDistance(floats, kOfKitti) : INFINITY;
  constexpr double kClearly = 0.8;  // of the least so far; points in no order at all have 0.75 and less
  for (std::size_t count = kLeast; count <= kMost; ++count)
    if (count != kOfKitti && divides(count))
      if (const double distance = medianDistance(floats, count); distance < kClearly * least)
      {
        best = count;
        least = distance;
      }
  return std::isinf(least) ? 0 : best;
}

/** Neither metres nor millimetres of anything that a lidar sees. What is not finite is no return. */
bool isAbsurd(float value) { return std::abs(value) > 1e6F || (value != 0 && std::abs(value) < 1e-12F); }
}  // namespace

CloudPoints pointsOfFloats(Bytes file)
{
  const std::vector<float> floats = firstFloats(file);
  const std::size_t count = floatsOfPoint(file, floats), size = count * sizeof(float);
  if (!file.empty() && count == 0)
    throw std::invalid_argument(fmt::format(
        "is no KITTI scan, or cut short: {} bytes are not points of 3 to 7 floats (KITTI: 4, 16 bytes)", file.size()));
  const auto absurd = static_cast<std::size_t>(std::count_if(floats.begin(), floats.end(), isAbsurd));
  if (absurd > floats.size() / 50)
    throw std::invalid_argument(fmt::format(
        "is no scan of floats (KITTI: x y z intensity): {} of its first {} numbers are no coordinates in metres",
        absurd, floats.size()));

  CloudPoints points;
  if (count != kOfKitti && !file.empty()) points.note = fmt::format("taken as {} floats a point, x y z first", count);
  points.positions.resize(file.empty() ? 0 : file.size() / size);
  for (std::size_t i = 0; i < points.positions.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      points.positions[i][static_cast<Eigen::Index>(axis)] = load<float>(file, i * size + axis * sizeof(float));
  return points;
}
}  // namespace scanloom
