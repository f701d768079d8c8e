/**
 * How a format of cloud files writes its header and its points, whose times count from `origin` and whose coordinates
 * are less `offset`, which the header names.
 */
#pragma once
#include "base/core/PointCloud.h"
#include "base/core/Time.h"
#include "base/formats/LittleEndianBuffer.h"

#include <fmt/format.h>

#include <memory>
#include <string>

namespace scanloom
{
class CloudEncoding
{
 public:
  virtual ~CloudEncoding() = default;

  /** Of the same length for every number of points: it is written again when the number is known. */
  virtual std::string header(std::size_t points) const = 0;

  /** Point `i` of the cloud; `position` has the offset. Throws std::runtime_error if the format cannot hold it. */
  virtual void put(LittleEndianBuffer&, const Eigen::Vector3d& position, Duration since_origin, const PointCloud&,
                   std::size_t i) = 0;
};

/** The line of a header that names the offset, after the mark of a comment; empty for none. */
inline std::string offsetLine(const char* mark, const Eigen::Vector3d& offset)
{
  return offset.isZero() ? ""
                         : fmt::format("{} offset {:.0f} {:.0f} {:.0f}\n", mark, offset.x(), offset.y(), offset.z());
}

/** PLY, the Polygon File Format (G. Turk, Stanford, 1994): what every viewer opens. */
std::unique_ptr<CloudEncoding> plyEncoding(Timestamp origin, const Eigen::Vector3d& offset, const std::string& wkt);

/** PCD, of the Point Cloud Library (its documentation: "The PCD (Point Cloud Data) file format"). */
std::unique_ptr<CloudEncoding> pcdEncoding(Timestamp origin, const Eigen::Vector3d& offset, const std::string& wkt);

/**
 * LAS 1.4 (ASPRS, LAS Specification 1.4-R15), point data record format 6: what tools for forests and surveys read.
 * `wkt`: of the coordinate reference system; empty: of none.
 */
std::unique_ptr<CloudEncoding> lasEncoding(Timestamp origin, const Eigen::Vector3d& offset, const std::string& wkt);
}  // namespace scanloom
