#include "base/formats/internal/KittiReader.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace scanloom
{
CloudPoints kittiPoints(Bytes file)
{
  constexpr std::size_t kPoint = 4 * sizeof(float);
  if (file.size() % kPoint != 0)
    throw std::invalid_argument(
        fmt::format("is no KITTI scan, or cut short: {} bytes are no multiple of {}", file.size(), kPoint));
  std::vector<Eigen::Vector3f> positions(file.size() / kPoint);
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      positions[i][static_cast<Eigen::Index>(axis)] = load<float>(file, i * kPoint + axis * sizeof(float));
  return {std::move(positions), {}};
}
}  // namespace scanloom
