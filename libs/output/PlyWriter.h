/** PLY: the one cloud format that every viewer opens. */
#pragma once
#include "core/PointCloud.h"
#include "core/Rigid.h"
#include "core/Time.h"
#include "output/OutputFile.h"

#include <optional>

namespace scanloom
{
/**
 * Binary little-endian vertices: float x y z, float intensity, double time, ushort ring, uchar sensor_id. `time` is
 * seconds after the header's "comment time_origin_ns N" (the stamp of the first cloud), exact to the nanosecond.
 * Streams: memory does not grow with the map.
 */
class PlyWriter
{
 public:
  explicit PlyWriter(const std::filesystem::path&);

  /** Appends the points, moved by frame_T_points; their t counts from `stamp`. */
  void add(const PointCloud&, Timestamp stamp, const Rigid& frame_T_points);

  /** Writes the number of points into the header and finishes the file. */
  void close();

  std::size_t size() const { return size_; }

 private:
  void writeHeader();

  OutputFile file_;
  std::optional<Timestamp> origin_;
  std::size_t size_ = 0;
};
}  // namespace scanloom
