/** A stand of stems on wavy ground as fixed points that every scan sees again, each column from the body's own pose
 * then. */
#pragma once
#include "base/core/Rigid.h"
#include "input/batching/Scan.h"

#include <functional>
#include <random>
#include <vector>

namespace scanloom
{
inline void append(Scan& scan, const Eigen::Vector3d& p)
{
  const std::size_t i = scan.points.size();
  scan.points.resize(i + 1);
  scan.points.x[i] = static_cast<float>(p.x());
  scan.points.y[i] = static_cast<float>(p.y());
  scan.points.z[i] = static_cast<float>(p.z());
  scan.points.range[i] = static_cast<std::uint32_t>(1000 * p.norm());
}

/** Of [start, start + 100 ms); `appendColumn` appends what is seen in a column, by its number and stamp. */
inline Scan scanOf(std::size_t columns, Timestamp start,
                   const std::function<void(Scan&, std::size_t column, Timestamp)>& appendColumn)
{
  Scan scan;
  scan.start = start;
  scan.period = 100ms;
  scan.columns_of = {static_cast<std::uint32_t>(columns)};
  for (std::size_t c = 0; c < columns; ++c)
  {
    Column column;
    column.stamp = start + scan.period * static_cast<std::int64_t>(c) / static_cast<std::int64_t>(columns);
    column.first_point = static_cast<std::uint32_t>(scan.points.size());
    column.measurement_id = static_cast<std::uint16_t>(c);
    appendColumn(scan, c, column.stamp);
    column.count = static_cast<std::uint16_t>(scan.points.size() - column.first_point);
    scan.columns.push_back(column);
  }
  return scan;
}

class StandOfStems
{
 public:
  /** `felled`: number of the stem that stands no more; none: -1. */
  explicit StandOfStems(unsigned seed = 1, int felled = -1)
  {
    std::mt19937 random(seed);
    const auto uniform = [&random](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
    for (int stem = 0; stem < 80; ++stem)
    {
      const double x = uniform(-30, 45), y = uniform(-30, 30), radius = uniform(0.08, 0.2);
      stems_.emplace_back(x, y);
      for (int i = 0; i < 120; ++i)
      {
        const double angle = uniform(0, 2 * M_PI);
        const Eigen::Vector3d p(x + radius * std::cos(angle), y + radius * std::sin(angle), uniform(0, 6));
        if (stem != felled) points_.push_back(p);
      }
    }
    for (int i = 0; i < 12000; ++i)
    {
      const double x = uniform(-30, 45), y = uniform(-30, 30);
      points_.emplace_back(x, y, 0.3 * std::sin(0.2 * x) + 0.2 * std::cos(0.3 * y));
    }
  }

  /** Where they stand, or stood. */
  const std::vector<Eigen::Vector2d>& stems() const { return stems_; }

  /** 64 columns in [start, start + 100 ms); map_T_body says where the body is at an instant. */
  Scan scanAt(Timestamp start, const std::function<Rigid(Timestamp)>& map_T_body) const
  {
    constexpr std::size_t kColumns = 64;
    return scanOf(kColumns, start,
                  [&](Scan& scan, std::size_t c, Timestamp stamp)
                  {
                    const Rigid body_T_map = map_T_body(stamp).inverse();
                    for (std::size_t i = c; i < points_.size(); i += kColumns) append(scan, body_T_map * points_[i]);
                  });
  }

 private:
  std::vector<Eigen::Vector2d> stems_;
  std::vector<Eigen::Vector3d> points_;
};
}  // namespace scanloom
