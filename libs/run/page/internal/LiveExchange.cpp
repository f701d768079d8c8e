#include "run/page/internal/LiveExchange.h"

#include <algorithm>
#include <iterator>

namespace scanloom
{
namespace
{
constexpr std::size_t kMostScans = 2, kMostKeyframes = 16, kMostPath = 100000;

template <typename Value>
void appendKeeping(std::size_t most, std::vector<Value>& to, std::vector<Value> from)
{
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  if (to.size() > most) to.erase(to.begin(), to.end() - static_cast<std::ptrdiff_t>(most));
}
}  // namespace

ThinCloud thinned(const PointCloud& cloud, std::size_t most)
{
  ThinCloud thin;
  if (cloud.empty() || most == 0) return thin;
  std::size_t step = (cloud.size() + most - 1) / most;
  // Neighbours in the cloud are the beams of a column: with an even step the same beams would be left out of each.
  if (step > 1) step |= 1;
  const std::size_t count = (cloud.size() + step - 1) / step;
  thin.positions.reserve(count);
  thin.t.reserve(count);
  thin.reflectivity.reserve(count);
  thin.lidar.reserve(count);
  for (std::size_t i = 0; i < cloud.size(); i += step)
  {
    thin.positions.push_back(cloud.position(i));
    thin.t.push_back(cloud.t[i]);
    thin.reflectivity.push_back(cloud.intensity[i]);
    thin.lidar.push_back(cloud.sensor_id[i]);
  }
  return thin;
}

void LiveNews::append(LiveNews other)
{
  if (other.restarted) *this = {};
  restarted = restarted || other.restarted;
  appendKeeping(kMostScans, scans, std::move(other.scans));
  appendKeeping(kMostKeyframes, keyframes, std::move(other.keyframes));
  appendKeeping(kMostPath, path, std::move(other.path));
}
}  // namespace scanloom
