#pragma once
#include "input/bags/BagReader.h"

namespace scanloom
{
/**
 * A .bag file of ROS 1, version 2.0: chunks in lz4 or bz2 or plain. It needs no index: without one (a bag that was not
 * closed), the file is read once more at the beginning to find its topics. Damaged chunks are left out. Throws
 * std::runtime_error if it can't be opened.
 */
std::unique_ptr<BagReader> openRos1Bag(const std::filesystem::path&);
}  // namespace scanloom
