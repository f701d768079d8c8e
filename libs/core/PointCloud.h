#pragma once
#include "core/Time.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace scanloom
{
/** Valid returns only, as a structure of arrays: every vector has the same length. */
struct PointCloud
{
  std::vector<float> x, y, z;           // m, in the frame that the owner names
  std::vector<float> intensity;         // reflectivity as the sensor scales it (Ouster: 0 to 255, calibrated)
  std::vector<std::int32_t> t;          // ns after the owner's stamp
  std::vector<std::uint16_t> ring;      // channel, 0 is the topmost beam
  std::vector<std::uint16_t> column;    // measurement id of the block
  std::vector<std::uint8_t> sensor_id;  // index of the lidar among those that are batched
  std::vector<std::uint32_t> range;     // mm, from the sensor
  std::vector<std::uint16_t> signal;    // photons; 0 where the packet profile has none
  std::vector<std::uint16_t> near_ir;   // photons; 0 where the packet profile has none

  std::size_t size() const { return x.size(); }
  bool empty() const { return x.empty(); }
  std::size_t capacity() const { return x.capacity(); }
  Eigen::Vector3f position(std::size_t i) const { return {x[i], y[i], z[i]}; }

  void resize(std::size_t);
  void reserve(std::size_t);
  void clear() { resize(0); }

  /** Copies point `from` of `other` to the end. */
  void append(const PointCloud& other, std::size_t from);

  /** Keeps the points for which keep[i] is not 0, in order. Throws std::invalid_argument if the sizes differ. */
  void keep(const std::vector<std::uint8_t>& keep);
};

/** Calls visitor(vector) for each array of the cloud, so that nobody lists them twice. */
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
}  // namespace scanloom
