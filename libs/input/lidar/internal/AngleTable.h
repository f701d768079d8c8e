/** The csv files in which makers supply the angles of a sensor's beams. */
#pragma once
#include "input/lidar/MetadataKeys.h"

#include <string>
#include <vector>

namespace scanloom
{
/** Degrees, by channel. */
struct AngleTable
{
  std::vector<double> vertical, azimuth;
};

/**
 * Rows "channel, vertical, azimuth" in any order, channels counted from 1, or rows "vertical, azimuth" in the order of
 * the channels; a first row of titles above three columns is skipped. Throws std::invalid_argument with `name`, line
 * and what is expected unless each channel has one row.
 */
AngleTable parseAngleTable(const std::string& text, const std::string& name, int channels);

/**
 * The list of `channels` numbers within +-limit that a key gives. Throws std::invalid_argument as MetadataKeys does;
 * `instead` completes the message that the key is missing.
 */
std::vector<double> numberPerChannel(const MetadataKeys&, const std::string& key, int channels, double limit,
                                     const char* instead = "");

/**
 * The angles of the csv file that the key "angles" of the metadata file `name` gives, relative to its folder; else of
 * the lists "vertical_angles_deg" and "azimuth_offsets_deg". Throws std::invalid_argument as parseAngleTable and
 * MetadataKeys do.
 */
AngleTable readAngles(const MetadataKeys& keys, const std::string& name, int channels);
}  // namespace scanloom
