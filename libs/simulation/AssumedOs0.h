/** An Ouster OS0 as its maker describes the model; the calibration of a single unit is assumed. */
#pragma once
#include "core/Field.h"
#include "lidar/OusterMetadata.h"

#include <string>

namespace scanloom
{
struct Os0Options
{
  int beams = 32;
  std::string mode = "512x10";
  std::string profile = "RNG15_RFL8_NIR8";
  double range_noise = 0.008;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.beams, Field{"beams", "", "lasers of each lidar; real ones have 32, 64 or 128", between(8, 128)});
    visit(o.mode, Field{"mode", "", "columns per turn and turns per second: 512x10, 1024x10, 512x20 ..."});
    visit(o.profile, Field{"profile", "", "layout of the lidar packets, by Ouster's name"});
    visit(o.range_noise, Field{"range_noise", "m", "standard deviation of a range", between(0, 0.2)});
  }
};

/**
 * Beams evenly over 90 degrees of altitude, except for the pincushion that makes real tables denser in the middle, and
 * the azimuth offsets of the four laser columns as a parabola around 8.4 degrees: within about 1 degree of real OS0-32
 * tables. Not the calibration of a real unit. Throws std::invalid_argument if the mode or the profile is unknown.
 */
OusterMetadata assumedOs0(const Os0Options&, const std::string& serial, std::uint32_t init_id,
                          std::uint16_t lidar_port);
}  // namespace scanloom
