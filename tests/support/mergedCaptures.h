#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "input/packets/CaptureReader.h"
#include "input/packets/MergedCaptures.h"

namespace scanloom
{
inline MergedCaptures mergedCaptures(const std::vector<std::filesystem::path>& paths)
{
  std::vector<std::unique_ptr<DatagramReader>> captures;
  for (const auto& path : paths) captures.push_back(std::make_unique<CaptureReader>(path));
  return MergedCaptures(std::move(captures));
}
}  // namespace scanloom
