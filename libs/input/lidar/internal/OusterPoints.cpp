#include "input/lidar/internal/OusterPoints.h"

#include "input/lidar/internal/OusterKernels.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
namespace
{
/** Points have no kernel of their own for AVX-512. */
const ouster_kernels::Table& tableOf(Kernel kernel)
{
  return kernel == Kernel::Portable ? ouster_kernels::kPortable : ouster_kernels::kAvx2;
}

std::size_t rowOf(const OusterProfile& profile)
{
  for (std::size_t i = 0; i < kOusterProfiles.size(); ++i)
    if (kOusterProfiles[i].name == profile.name) return i;
  throw std::invalid_argument("OusterPoints: not a row of kOusterProfiles");
}
}  // namespace

OusterPoints::OusterPoints(const OusterProfile& profile, BeamTable table, Kernel kernel)
  : beams_(std::move(table)),
    room_(ouster_kernels::roomFor(static_cast<std::size_t>(beams_.size()), profile.returns())),
    write_(tableOf(kernel)[rowOf(profile)])
{
  if (!isRunnable(kernel))
    throw std::invalid_argument(fmt::format("kernel {}: this machine cannot run it", nameOf(kernel)));
  const auto beams = static_cast<std::size_t>(beams_.size());
  if (!beams_.hasOneOrigin() || beams == 0 || beams > kMostOusterChannels)
    throw std::invalid_argument("OusterPoints: 1 to 256 beams of one origin are needed");
}
}  // namespace scanloom
