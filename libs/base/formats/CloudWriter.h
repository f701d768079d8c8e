/** Writes clouds into one file, in the format of its name's ending. */
#pragma once
#include "base/core/OutputFile.h"
#include "base/core/Rigid.h"
#include "base/formats/internal/CloudEncoding.h"

#include <vector>

namespace scanloom
{
/**
 * Binary little-endian points, each cloud written at once: memory does not grow with the file. The time of a point is
 * in s after the stamp of the first cloud. Floats and steps of 1 mm hold no coordinates of a country: what is to be
 * added to those in the file is the `offset` in LAS's own field, and in a comment "offset x y z" of PLY and PCD.
 * - .ply: float x y z, float intensity, double time, ushort ring, uchar sensor_id; the first stamp is in the header's
 *   "comment time_origin_ns N".
 * - .pcd: float x y z, float intensity, double t, uint16 ring and column, uint8 sensor_id; the first stamp is in the
 *   comment of the header.
 * - .las: coordinates in steps of 1 mm, intensity times 257, GPS time (LAS counts it from 2011-09-14 on; stamps are
 *   taken for UTC), the ring as user data, sensor_id + 1 as point source, and as scanner channel where it is below 4.
 * - .laz: the same, compressed by close() from a .las file that is removed then.
 */
class CloudWriter
{
 public:
  static const std::vector<std::string>& endings();

  /**
   * `wkt`: what LAS files name as the coordinate reference system; other formats do not.
   * Throws std::invalid_argument for another ending, UsageError for .laz without LASzip, and std::runtime_error if the
   * file cannot be written.
   */
  explicit CloudWriter(const std::filesystem::path&, const Eigen::Vector3d& offset = Eigen::Vector3d::Zero(),
                       const std::string& wkt = "");

  /**
   * Appends the points, transformed by frame_T_points. Their t is relative to `stamp`. Throws std::runtime_error if the
   * format cannot hold one.
   */
  void add(const PointCloud&, Timestamp stamp, const Rigid& frame_T_points);

  /** Writes the number of points into the header and finishes the file. */
  void close();

  std::size_t size() const { return size_; }

 private:
  struct Format;
  static const std::vector<Format>& formats();
  static const Format& formatOf(const std::filesystem::path&);
  void begin(Timestamp origin);

  const Format& format_;
  OutputFile file_;
  Eigen::Vector3d offset_;
  std::string wkt_;
  std::unique_ptr<CloudEncoding> encoding_;  // none before the first cloud
  Timestamp origin_;
  std::size_t size_ = 0;
};
}  // namespace scanloom
