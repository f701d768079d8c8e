/** Metadata in the layout of the HTTP interface. */
#pragma once
#include <nlohmann/json.hpp>

#include <string>

namespace scanloom
{
/**
 * Metadata with a section per endpoint (sensor_info, beam_intrinsics, ..., config_params), from either layout. Throws
 * std::invalid_argument if the text is no JSON object.
 */
nlohmann::json sensorSections(const std::string& metadata);
}  // namespace scanloom
