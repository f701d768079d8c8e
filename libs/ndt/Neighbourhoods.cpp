#include "ndt/Neighbourhoods.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

namespace scanloom
{
namespace
{
std::vector<Eigen::Vector3i> offsetsOf(int neighbours)
{
  int most_axes;  // along how many axes a neighbour may differ
  switch (neighbours)
  {
    case 1:
      most_axes = 0;
      break;
    case 7:
      most_axes = 1;
      break;
    case 27:
      most_axes = 3;
      break;
    default:
      throw std::invalid_argument(fmt::format("RegistrationOptions: neighbours = {}: must be 1, 7 or 27", neighbours));
  }
  std::vector<Eigen::Vector3i> offsets;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (x * x + y * y + z * z <= most_axes) offsets.emplace_back(x, y, z);
  return offsets;
}
}  // namespace

Neighbourhoods::Neighbourhoods(const NdtMap& target, const NdtMap& source, int neighbours)
  : target_(target), source_(source), offsets_(offsetsOf(neighbours))
{
  const std::size_t cells = source.cells().size();
  centres_.assign(cells, Eigen::Vector3i::Constant(std::numeric_limits<int>::min()));
  found_.resize(cells * offsets_.size());
  counts_.assign(cells, 0);
}

void Neighbourhoods::moveTo(const Rigid& target_T_source)
{
  const Eigen::Matrix3d rotation = target_T_source.rotation.toRotationMatrix();
  const GaussianCell* const first = target_.cells().data();
  for (std::size_t i = 0; i < centres_.size(); ++i)
  {
    const Eigen::Vector3i centre = target_.indexOf(rotation * source_.cells()[i].mean + target_T_source.translation);
    if (centre == centres_[i]) continue;
    centres_[i] = centre;
    std::uint32_t* end = found_.data() + i * offsets_.size();
    for (const Eigen::Vector3i& offset : offsets_)
      if (const GaussianCell* cell = target_.cellAt(centre + offset)) *end++ = static_cast<std::uint32_t>(cell - first);
    counts_[i] = static_cast<std::uint32_t>(end - (found_.data() + i * offsets_.size()));
  }
}
}  // namespace scanloom
