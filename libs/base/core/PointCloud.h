#pragma once
#include "base/core/Array.h"
#include "base/core/Time.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace scanloom
{
/**
 * Memory behind the last point of a PointCloud, one pointer per field. In inner loops pass it by value: behind a
 * reference, the compiler loads all pointers again after each write.
 */
struct PointRoom
{
  float *x, *y, *z;
  std::int32_t* t;
  std::uint16_t* column;
  std::uint8_t *intensity, *ring, *sensor_id;
  std::uint32_t* range;
  std::uint16_t *signal, *near_ir;
};

/** Points as a structure of arrays of equal length. Points are returns: none has range 0. */
struct PointCloud
{
  Array<float> x, y, z;           // m, in the frame that the owner names
  Array<std::uint8_t> intensity;  // reflectivity as the sensor scales it (Ouster: 0 to 255, calibrated)
  Array<std::int32_t> t;          // ns after the owner's stamp
  Array<std::uint8_t> ring;       // channel, 0 is the topmost beam
  Array<std::uint16_t> column;    // measurement id of the block
  Array<std::uint8_t> sensor_id;  // index of the lidar among those that are batched
  Array<std::uint32_t> range;     // mm, from the sensor
  Array<std::uint16_t> signal;    // photons; 0 where the packet profile has none
  Array<std::uint16_t> near_ir;   // photons; 0 where the packet profile has none

  std::size_t size() const { return x.size(); }
  bool empty() const { return x.empty(); }
  std::size_t capacity() const { return x.capacity(); }
  Eigen::Vector3f position(std::size_t i) const { return {x[i], y[i], z[i]}; }

  /** New points are 0 in every field. */
  void resize(std::size_t);
  void reserve(std::size_t);
  void clear() { resize(0); }

  /** Uninitialised memory for `count` points behind the last one. grow() adds those that were written. */
  PointRoom room(std::size_t count)
  {
    return {x.room(count),      y.room(count),         z.room(count),      t.room(count),
            column.room(count), intensity.room(count), ring.room(count),   sensor_id.room(count),
            range.room(count),  signal.room(count),    near_ir.room(count)};
  }
  void grow(std::size_t count);

  /** Copies all points of `other` to the end. */
  void append(const PointCloud& other);

  /** Copies point `from` of `other` to the end. */
  void append(const PointCloud& other, std::size_t from);

  /** Keeps the points with keep[i] != 0, in order. Throws std::invalid_argument if the sizes differ. */
  void keep(const std::vector<std::uint8_t>& keep);
};

/** Calls visit(array) for each array of the cloud. */
template <typename Cloud, typename Visitor>
void forEachField(Cloud& cloud, Visitor&& visit)
{
  visit(cloud.x);
  visit(cloud.y);
  visit(cloud.z);
  visit(cloud.intensity);
  visit(cloud.t);
  visit(cloud.ring);
  visit(cloud.column);
  visit(cloud.sensor_id);
  visit(cloud.range);
  visit(cloud.signal);
  visit(cloud.near_ir);
}

inline void PointCloud::grow(std::size_t count)
{
  forEachField(*this, [count](auto& field) { field.grow(count); });
}
}  // namespace scanloom
