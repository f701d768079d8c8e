#pragma once
#include "input/bags/BagReader.h"

namespace scanloom
{
/**
 * A .db3 file of ROS 2, plain or with each message in zstd, or the whole file in gzip or zstd: then it is unpacked to a
 * temporary file. Of a file that was cut, as much as SQLite finds. Throws std::runtime_error if it is no bag.
 */
std::unique_ptr<BagReader> openSqliteBag(const std::filesystem::path&);
}  // namespace scanloom
