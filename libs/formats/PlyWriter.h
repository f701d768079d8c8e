/** PLY, the cloud format that every viewer opens. */
#pragma once
#include "core/OutputFile.h"
#include "core/PointCloud.h"
#include "core/Rigid.h"
#include "core/Time.h"

#include <optional>

namespace scanloom
{
/**
 * Binary little-endian vertices: float x y z, float intensity, double time, ushort ring, uchar sensor_id. `time` is in
 * s after the header's "comment time_origin_ns N" (the stamp of the first cloud). Each cloud is written at once: memory
 * does not grow with the file.
 */
class PlyWriter
{
 public:
  explicit PlyWriter(const std::filesystem::path&);

  /** Appends the points, transformed by frame_T_points. Their t is relative to `stamp`. */
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
