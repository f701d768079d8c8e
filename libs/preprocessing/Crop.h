/** Removes the points of the machine that carries the lidars, and those too near or too far to be of use. */
#pragma once
#include "batching/Scan.h"
#include "core/Field.h"

namespace scanloom
{
/** An axis-aligned box in the body frame whose inside is removed (paper, section 2.2), and limits of the measured
 * range. */
struct CropOptions
{
  // A harvester with its boom, generously: better to lose some trees than to keep a part of the machine.
  double min_x = -4.0, max_x = 10.0;
  double min_y = -3.0, max_y = 3.0;
  double min_z = -0.5, max_z = 6.0;
  double min_range = 0.5;
  double max_range = 100.0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.min_x, Field{"min_x", "m", "rear of the machine's box in the body frame"});
    visit(o.max_x, Field{"max_x", "m", "front of the box"});
    visit(o.min_y, Field{"min_y", "m", "right side of the box"});
    visit(o.max_y, Field{"max_y", "m", "left side of the box"});
    visit(o.min_z, Field{"min_z", "m", "bottom of the box"});
    visit(o.max_z, Field{"max_z", "m", "top of the box"});
    visit(o.min_range, Field{"min_range", "m", "nearer readings are removed", atLeast(0)});
    visit(o.max_range, Field{"max_range", "m", "farther readings are removed", above(0)});
  }
};

/** The scan without those points; columns keep their stamps even when they become empty. Ranges count from the sensor,
 * where known. */
Scan cropOut(Scan scan_in_body, const CropOptions&);
}  // namespace scanloom
