/** Removes the points of the machine that carries the lidars, and those too near or too far to be of use. */
#pragma once
#include "base/core/Field.h"
#include "estimation/preprocessing/LidarBox.h"
#include "input/batching/Scan.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * An axis-aligned box in the body frame whose inside is removed (paper, section 2.2), boxes in the frames of single
 * lidars, and limits of the measured range.
 */
struct CropOptions
{
  double min_x = 0, max_x = 0;
  double min_y = 0, max_y = 0;
  double min_z = 0, max_z = 0;
  double min_range = 0.5;
  double max_range = 100.0;
  std::string lidar_boxes;

  static constexpr const char* kMeaning = "the machine's own points, and the ranges that are used";

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.min_x, Field{"min_x", "m", "rear of the machine's box in the body frame; the default is no box"});
    visit(o.max_x, Field{"max_x", "m", "front of the box"});
    visit(o.min_y, Field{"min_y", "m", "right side of the box"});
    visit(o.max_y, Field{"max_y", "m", "left side of the box"});
    visit(o.min_z, Field{"min_z", "m", "bottom of the box"});
    visit(o.max_z, Field{"max_z", "m", "top of the box"});
    visit(o.min_range, Field{"min_range", "m", "nearer readings are removed", atLeast(0)});
    visit(o.max_range, Field{"max_range", "m", "farther readings are removed", above(0)});
    visit(
        o.lidar_boxes,
        Field{"lidar_boxes", "",
              "boxes in the frame of one lidar whose inside is removed, for what it sees of its own mount: NAME x0 y0 "
              "z0 x1 y1 z1 in m, several separated by commas"});
  }

  template <typename Self, typename Visitor>
  static void order(const Self& o, Visitor&& visit)
  {
    visit("min_x", o.min_x, "max_x", o.max_x);
    visit("min_y", o.min_y, "max_y", o.max_y);
    visit("min_z", o.min_z, "max_z", o.max_z);
    visit("min_range", o.min_range, "max_range", o.max_range);
  }
};

/** Points of a lidar by what removed them. Each is counted once, by the first reason that applies. */
struct CropCounts
{
  std::uint64_t not_finite = 0;
  std::uint64_t machine = 0;    // in the machine's box
  std::uint64_t lidar_box = 0;  // in a box of this lidar
  std::uint64_t too_near = 0;
  std::uint64_t too_far = 0;
  std::uint64_t kept = 0;

  std::uint64_t all() const;
  CropCounts& operator+=(const CropCounts&);

  /** Calls visit(name, member) for each. */
  template <typename Visitor>
  static void forEach(Visitor&& visit)
  {
    visit("not_finite", &CropCounts::not_finite);
    visit("machine", &CropCounts::machine);
    visit("lidar_box", &CropCounts::lidar_box);
    visit("too_near", &CropCounts::too_near);
    visit("too_far", &CropCounts::too_far);
    visit("kept", &CropCounts::kept);
  }
};

struct CroppedScan
{
  Scan scan;
  std::vector<CropCounts> counts;  // by sensor id, up to the largest that has a column
};

/** What is removed from scans: the options, applied to the lidars that there are. */
struct Crop
{
  Eigen::AlignedBox3d machine;  // in the body frame
  std::vector<LidarBox> lidar_boxes;
  double min_range = 0, max_range = 0;  // m
};

/** Throws ConfigError if lidar_boxes is not well formed, or names a lidar that is not among `lidars` (by sensor id). */
Crop cropOf(const CropOptions&, const std::vector<MountedLidar>& lidars = {});

/** Whether the point, in the body frame, is removed. */
bool removes(const Crop&, const PointCloud&, std::size_t i);

/** The scan without those points. Columns keep their stamps even when they become empty. Ranges are measured from the
 * sensor; a point with range 0 is not tested for them. */
CroppedScan cropOut(Scan scan_in_body, const Crop&);
}  // namespace scanloom
