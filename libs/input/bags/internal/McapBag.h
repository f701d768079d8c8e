#pragma once
#include "input/bags/BagReader.h"

namespace scanloom
{
/**
 * An MCAP file (mcap.dev, version 0): chunks in lz4 or zstd or plain, or messages without chunks. It needs no index:
 * without one, the file is read once more at the beginning to find its topics. Damaged chunks are left out. Throws
 * std::runtime_error if it can't be opened.
 */
std::unique_ptr<BagReader> openMcapBag(const std::filesystem::path&);
}  // namespace scanloom
