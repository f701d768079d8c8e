#include "mrpt/maps/MapFiles.h"

#include "base/config/Names.h"
#include "base/core/ConfigError.h"
#include "base/formats/CloudWriter.h"
#include "mrpt/maps/SceneFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace scanloom
{
namespace
{
using Paths = std::vector<std::filesystem::path>;

std::vector<std::string> allEndings()
{
  std::vector<std::string> endings{".bt", ".ot"};
  const std::vector<std::string>& clouds = CloudWriter::endings();
  endings.insert(endings.end(), clouds.begin(), clouds.end());
  endings.insert(endings.end(), {".simplemap", ".3Dscene"});
  return endings;
}

/** The keyframe in a frame whose origin is at `offset`. */
Keyframe less(Keyframe keyframe, const Eigen::Vector3d& offset)
{
  keyframe.map_T_body.translation -= offset;
  return keyframe;
}

std::filesystem::path withEnding(const Paths& paths, const std::string& ending)
{
  const auto found = std::find_if(paths.begin(), paths.end(), [&](const auto& p) { return p.extension() == ending; });
  return found == paths.end() ? std::filesystem::path() : *found;
}
}  // namespace

void requireMapEndings(const Paths& paths)
{
  const std::vector<std::string> known = allEndings();
  std::set<std::string> seen;
  for (const std::filesystem::path& path : paths)
  {
    const std::string ending = path.extension().string();
    if (std::find(known.begin(), known.end(), ending) == known.end())
      throw UsageError(
          fmt::format("-o {}: '{}' is no ending of a map: {}", path.string(), ending, suggestion(ending, known)));
    if (!seen.insert(ending).second) throw UsageError(fmt::format("-o: two outputs end in {}", ending));
  }
}

Eigen::Vector3d offsetFor(const Rigid& first_pose)
{
  constexpr double kNear = 10e3, kWhole = 1000;  // m; a float resolves 1 mm up to there
  if (first_pose.translation.norm() <= kNear) return Eigen::Vector3d::Zero();
  return kWhole * (first_pose.translation / kWhole).array().round() + 0.0;  // no -0 in what is printed
}

class MapFiles::File
{
 public:
  virtual ~File() = default;
  virtual void add(const Keyframe&) = 0;
  virtual void close() = 0;
  virtual std::uint64_t leftOut() const { return 0; }
};

class MapFiles::Cloud : public File
{
 public:
  Cloud(const std::filesystem::path& path, const Eigen::Vector3d& offset) : writer_(path, offset) {}
  void add(const Keyframe& keyframe) override { writer_.add(keyframe.points, keyframe.stamp, keyframe.map_T_body); }
  void close() override { writer_.close(); }

 private:
  CloudWriter writer_;
};

class MapFiles::SimpleMap : public File
{
 public:
  SimpleMap(const std::filesystem::path& path, const std::vector<MountedLidar>& lidars) : writer_(path, lidars) {}
  void add(const Keyframe& keyframe) override { writer_.add({keyframe}); }
  void close() override { writer_.close(); }

 private:
  SimpleMapWriter writer_;
};

class MapFiles::Scene : public File
{
 public:
  Scene(std::filesystem::path path, const Eigen::Vector3d& offset) : path_(std::move(path)), offset_(offset) {}
  void add(const Keyframe& keyframe) override
  {
    builder_.addKeyframe(less(keyframe, offset_));
    poses_.push_back({keyframe.stamp, less(keyframe, offset_).map_T_body});
  }
  void close() override
  {
    builder_.addPath(poses_);
    writeScene(path_, *builder_.finished());
  }

 private:
  std::filesystem::path path_;
  Eigen::Vector3d offset_;
  SceneBuilder builder_;
  Trajectory poses_;
};

class MapFiles::OctoMap : public File
{
 public:
  OctoMap(std::filesystem::path binary, std::filesystem::path full, const OctoMapOptions& options,
          const std::vector<MountedLidar>& lidars, const Eigen::Vector3d& offset)
    : binary_(std::move(binary)), full_(std::move(full)), offset_(offset), builder_(options, posesOf(lidars))
  {
  }
  void add(const Keyframe& keyframe) override { builder_.add(less(keyframe, offset_)); }
  void close() override { std::move(builder_).write(binary_, full_); }
  std::uint64_t leftOut() const override { return builder_.leftOut(); }

 private:
  std::filesystem::path binary_, full_;
  Eigen::Vector3d offset_;
  OctoMapBuilder builder_;
};

MapFiles::MapFiles(const Paths& paths, const std::vector<MountedLidar>& lidars, const OctoMapOptions& options,
                   const Eigen::Vector3d& offset)
{
  for (const std::string& ending : CloudWriter::endings())
    if (const auto cloud = withEnding(paths, ending); !cloud.empty())
      files_.push_back(std::make_unique<Cloud>(cloud, offset));
  if (const auto keyframes = withEnding(paths, ".simplemap"); !keyframes.empty())
    files_.push_back(std::make_unique<SimpleMap>(keyframes, lidars));
  if (const auto scene = withEnding(paths, ".3Dscene"); !scene.empty())
    files_.push_back(std::make_unique<Scene>(scene, offset));
  const auto binary = withEnding(paths, ".bt"), full = withEnding(paths, ".ot");
  if (!binary.empty() || !full.empty())
    files_.push_back(std::make_unique<OctoMap>(binary, full, options, lidars, offset));
}

MapFiles::~MapFiles() = default;

void MapFiles::add(const Keyframe& keyframe)
{
  for (const auto& file : files_) file->add(keyframe);
}

void MapFiles::close()
{
  for (const auto& file : files_) file->close();
}

std::uint64_t MapFiles::leftOut() const
{
  return std::accumulate(files_.begin(), files_.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& file) { return sum + file->leftOut(); });
}
}  // namespace scanloom
