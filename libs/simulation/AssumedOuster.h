/** Ouster's spinning models as their maker describes them; the calibration of a single unit is assumed. */
#pragma once
#include "lidar/OusterMetadata.h"

#include <cstdint>
#include <string>

namespace scanloom
{
/** What the data sheets say of a family, as far as a simulated unit needs it. */
struct OusterFamily
{
  const char* name;                                          // "OS0"
  double least_range;                                        // m
  double range_at_ten_percent;                               // m, half of the returns at 10 % reflectivity
  double edge_deg;                                           // altitude of the topmost beam, of an evenly spread fan
  double pincushion_deg;                                     // added to it, and with the third power towards the middle
  double inner_azimuth_deg, outer_azimuth_deg, azimuth_bow;  // of four columns of lasers, and its share at the edge
  double beam_radius_mm, lidar_height_mm;
};

/** By "OS0", "OS0-32" or "OS-0-128"; throws std::invalid_argument for another text. */
const OusterFamily& ousterFamily(const std::string& model);

/** What is chosen about a unit without a metadata file of its own. */
struct OusterUnit
{
  std::string model = "OS0-32";  // OS0, OS1 or OS2, with 8 to 128 beams; real ones have 32, 64 or 128
  std::string mode = "512x10";
  std::string profile = "RNG15_RFL8_NIR8";
  std::string serial = "122150000101";
  std::uint32_t init_id = 1;
  std::uint16_t lidar_port = 7502;  // its IMU's is the next one
};

/**
 * Beams evenly over the family's field of view, except for the pincushion that makes an OS0's tables denser in the
 * middle; 64 and more beams alternate between four columns of lasers, fewer are one column. Within 1.5 degrees of real
 * tables, not the calibration of a real unit. Throws std::invalid_argument if model, mode or profile is unknown.
 */
OusterMetadata assumedOuster(const OusterUnit&);

/** Sets what 'mode' says; throws std::invalid_argument if it is none of Ouster's. */
void setMode(OusterMetadata&, const std::string& mode);
void setProfile(OusterMetadata&, const std::string& profile);
}  // namespace scanloom
