#include "run/run/internal/CropReport.h"

#include <fmt/format.h>

namespace scanloom
{
void addCounts(const std::vector<CropCounts>& cropped, const std::vector<RecordedLidar>& lidars,
               std::map<std::string, std::uint64_t>& counts)
{
  for (std::size_t i = 0; i < cropped.size(); ++i)
    CropCounts::forEach([&](const char* name, auto count)
                        { counts[fmt::format("{}.points_{}", lidars.at(i).name, name)] = cropped[i].*count; });
}

std::vector<std::string> cropWarnings(const std::vector<CropCounts>& cropped, const std::vector<RecordedLidar>& lidars)
{
  constexpr double kLeast = 0.1, kMost = 0.9;
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < cropped.size(); ++i)
  {
    const CropCounts& c = cropped[i];
    if (static_cast<double>(c.kept) >= kLeast * static_cast<double>(c.all())) continue;
    warnings.push_back(
        fmt::format("[crop] leaves {} of {} points of lidar '{}': {} are in the machine's box, {} in its own, {} too "
                    "near, {} too far{}",
                    c.kept, c.all(), lidars.at(i).name, c.machine, c.lidar_box, c.too_near, c.too_far,
                    static_cast<double>(c.too_far) > kMost * static_cast<double>(c.all()) ? ": are they in mm?" : ""));
  }
  return warnings;
}
}  // namespace scanloom
