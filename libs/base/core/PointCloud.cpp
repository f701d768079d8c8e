#include "base/core/PointCloud.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace scanloom
{
void PointCloud::resize(std::size_t n)
{
  forEachField(*this, [n](auto& field) { field.resize(n); });
}

void PointCloud::reserve(std::size_t n)
{
  forEachField(*this, [n](auto& field) { field.reserve(n); });
}

void PointCloud::append(const PointCloud& other)
{
  const PointRoom to = room(other.size());
  const auto copy = [](const auto& from, auto* target) { std::copy(from.begin(), from.end(), target); };
  copy(other.x, to.x);
  copy(other.y, to.y);
  copy(other.z, to.z);
  copy(other.intensity, to.intensity);
  copy(other.t, to.t);
  copy(other.ring, to.ring);
  copy(other.column, to.column);
  copy(other.sensor_id, to.sensor_id);
  copy(other.range, to.range);
  copy(other.signal, to.signal);
  copy(other.near_ir, to.near_ir);
  grow(other.size());
}

void PointCloud::append(const PointCloud& other, std::size_t i)
{
  x.push_back(other.x[i]);
  y.push_back(other.y[i]);
  z.push_back(other.z[i]);
  intensity.push_back(other.intensity[i]);
  t.push_back(other.t[i]);
  ring.push_back(other.ring[i]);
  column.push_back(other.column[i]);
  sensor_id.push_back(other.sensor_id[i]);
  range.push_back(other.range[i]);
  signal.push_back(other.signal[i]);
  near_ir.push_back(other.near_ir[i]);
}

void PointCloud::keep(const std::vector<std::uint8_t>& keep)
{
  if (keep.size() != size()) throw std::invalid_argument("PointCloud::keep: one flag per point is needed");
  std::vector<std::uint32_t> kept(size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < size(); ++i)
  {
    kept[count] = static_cast<std::uint32_t>(i);  // no branch: it could not be predicted
    count += keep[i] != 0;
  }
  std::vector<std::function<void()>> fields;
  forEachField(*this,
               [&](auto& field)
               {
                 fields.push_back(
                     [&]
                     {
                       std::decay_t<decltype(field)> left;  // not in place: what is kept is often half
                       auto* to = left.room(count);
                       for (std::size_t i = 0; i < count; ++i) to[i] = field[kept[i]];
                       left.grow(count);
                       field = std::move(left);
                     });
               });
  tbb::parallel_for(std::size_t{0}, fields.size(), [&](std::size_t i) { fields[i](); });
}
}  // namespace scanloom
