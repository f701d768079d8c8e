/** PCD, the cloud format of the Point Cloud Library (its documentation: "The PCD (Point Cloud Data) file format"). */
#pragma once
#include "core/PointCloud.h"

#include <filesystem>

namespace scanloom
{
/**
 * Binary: float x y z intensity, float t (s after the cloud's stamp), uint16 ring and column, uint8 sensor_id. Throws
 * std::runtime_error if it cannot be written; then there is no file of that name.
 */
void writePcd(const std::filesystem::path&, const PointCloud&);
}  // namespace scanloom
