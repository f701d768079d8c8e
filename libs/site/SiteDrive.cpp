#include "site/SiteDrive.h"

#include "base/formats/Trajectory.h"
#include "mrpt/maps/KeyframeTable.h"
#include "mrpt/maps/SimpleMapReader.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
std::filesystem::path existing(const std::filesystem::path& folder, const char* name)
{
  std::filesystem::path file = folder / name;
  if (!std::filesystem::exists(file))
    throw std::runtime_error(fmt::format(
        "{}: has no {}: a site is made of result folders of `scanloom slam`, run with maps (output.maps = true)",
        folder.string(), name));
  return file;
}

/** rad, of roll and pitch together. */
double tiltSigma(const Matrix6d& covariance) { return std::sqrt(0.5 * (covariance(3, 3) + covariance(4, 4))); }
}  // namespace

SiteDrive::SiteDrive(const std::filesystem::path& folder)
  : folder_(folder),
    reader_(std::make_unique<SimpleMapReader>(existing(folder, "keyframes.simplemap"))),
    trajectory_(readTum(existing(folder, "trajectory.tum")))
{
  const std::filesystem::path table = existing(folder, "keyframes.csv");
  const std::vector<KeyframeRow> rows = readKeyframeTable(table);
  if (rows.size() != reader_->size())
    throw std::runtime_error(
        fmt::format("{}: has {} keyframes, keyframes.simplemap {}: they are of other runs, or of "
                    "several drives (--grow), which a site is not made of",
                    table.string(), rows.size(), reader_->size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    keyframes_.push_back({rows[i].stamp, reader_->pose(i), rows[i].covariance,
                          upInBody(poseAt(trajectory_, rows[i].stamp).value_or(reader_->pose(i))),
                          tiltSigma(reader_->covariance(i)), rows[i].begins_map});
}

SiteDrive::~SiteDrive() = default;
SiteDrive::SiteDrive(SiteDrive&&) noexcept = default;

const std::vector<MountedLidar>& SiteDrive::lidars() const { return reader_->lidars(); }

Keyframe SiteDrive::keyframe(std::size_t index) const { return reader_->keyframe(index); }
}  // namespace scanloom
