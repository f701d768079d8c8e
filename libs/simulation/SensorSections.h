/** The layout in which sensors tell their metadata over HTTP. */
#pragma once
#include <nlohmann/json.hpp>

#include <string>

namespace scanloom
{
/**
 * Metadata with a section per endpoint (sensor_info, beam_intrinsics, ..., config_params); the flat layout of older
 * files is sorted into them. Throws std::invalid_argument if the text is no JSON object.
 */
nlohmann::json sensorSections(const std::string& metadata);
}  // namespace scanloom
