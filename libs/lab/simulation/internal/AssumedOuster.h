/** Metadata of Ouster's models from data sheets, with assumed beam angles: for simulation without a real unit's file.
 */
#pragma once
#include "input/lidar/OusterMetadata.h"

#include <cstdint>
#include <string>

namespace scanloom
{
/** Values of a family's data sheet that a simulated unit needs. */
struct OusterFamily
{
  const char* name;             // "OS0"
  double least_range;           // m
  double range_at_ten_percent;  // m, where half of the returns of 10 % reflectivity are lost
  double edge_deg;              // altitude of the topmost beam of an evenly spread fan
  double pincushion_deg;        // added to it; to other beams by the third power of their altitude
  double inner_azimuth_deg, outer_azimuth_deg,
      azimuth_bow;  // of four columns of lasers; azimuths are larger by azimuth_bow at the edge
  double beam_radius_mm, lidar_height_mm;
};

/** `model` is "OS0", "OS0-32" or "OS-0-128". Throws std::invalid_argument for any other text. */
const OusterFamily& ousterFamily(const std::string& model);

/** A unit that has no metadata file. */
struct OusterUnit
{
  std::string model = "OS0-32";  // OS0, OS1 or OS2, with 8 to 128 beams; real ones have 32, 64 or 128
  std::string mode = "512x10";
  std::string profile = "RNG15_RFL8_NIR8";
  std::string serial = "122150000101";
  std::uint32_t init_id = 1;
  std::uint16_t lidar_port = kOusterLidarPort;  // the port of its IMU is one higher
};

/**
 * Beams lie evenly over the family's field of view, but an OS0's are denser in the middle. From 64 beams on they
 * alternate between four columns of lasers; fewer are one column. Angles are within 1.5 degrees of real units' tables.
 * Throws std::invalid_argument if model, mode or profile is unknown.
 */
OusterMetadata assumedOuster(const OusterUnit&);

/** Set what follows from the mode or profile. Throw std::invalid_argument if it is none of Ouster's. */
void setMode(OusterMetadata&, const std::string& mode);
void setProfile(OusterMetadata&, const std::string& profile);
}  // namespace scanloom
