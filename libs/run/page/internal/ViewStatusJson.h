#pragma once
#include "run/page/internal/ViewStatus.h"

#include <filesystem>
#include <string>

namespace scanloom
{
/** What of this computer may run out. */
struct ComputerStatus
{
  std::uint64_t disk_free = 0;  // bytes
  std::uint64_t memory = 0;     // bytes that this program has
};
ComputerStatus computerStatus(const std::filesystem::path& folder);

/** The event that the page gets several times a second; its members are those of ViewStatus. One line. */
std::string toJson(const ViewStatus&, const ComputerStatus&, std::chrono::steady_clock::time_point now);
}  // namespace scanloom
