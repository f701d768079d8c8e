/** The csv files in which makers supply the angles of a sensor's beams. */
#pragma once
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
 * Rows "channel, vertical, azimuth" in any order, channels counted from 1; a first row of titles is skipped. Throws
 * std::invalid_argument with `name`, line and what is expected unless each channel has one row.
 */
AngleTable parseAngleTable(const std::string& text, const std::string& name, int channels);
}  // namespace scanloom
