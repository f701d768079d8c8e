/** PLY, the cloud format of the Stanford repository that every viewer opens. */
#pragma once
#include "core/Bytes.h"
#include "core/PointCloud.h"
#include "core/Time.h"

#include <Eigen/Core>

#include <filesystem>
#include <vector>

namespace scanloom
{
struct PlyContent
{
  PointCloud points;              // t is 0: see stamps. What the file does not have is 0.
  std::vector<Timestamp> stamps;  // one a point; empty if the file has no property `time`
};

/**
 * Any PLY, binary of either endianness or ascii, whose first element is `vertex` with scalar properties, x, y and z
 * among them; foreign properties are skipped. Throws std::invalid_argument with the file and what is wrong.
 */
PlyContent readPly(const std::filesystem::path&);

/** The same for x, y and z alone of a file in memory; the message does not name the file. */
std::vector<Eigen::Vector3f> plyPositions(Bytes file);
}  // namespace scanloom
