#include "mrpt/maps/MapFile.h"

#include "base/config/Names.h"
#include "base/core/ConfigError.h"
#include "base/formats/CloudWriter.h"
#include "mrpt/maps/SceneFile.h"

#include <fmt/format.h>

#include <algorithm>
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

class CloudMap : public MapFile
{
 public:
  explicit CloudMap(const std::filesystem::path& path) : writer_(path) {}
  void add(const Keyframe& keyframe) override { writer_.add(keyframe.points, keyframe.stamp, keyframe.map_T_body); }
  void close() override { writer_.close(); }

 private:
  CloudWriter writer_;
};

class SimpleMap : public MapFile
{
 public:
  SimpleMap(std::filesystem::path path, const std::vector<MountedLidar>& lidars)
    : path_(std::move(path)), builder_(lidars)
  {
  }
  void add(const Keyframe& keyframe) override { builder_.add(keyframe); }
  void close() override { builder_.write(path_); }

 private:
  std::filesystem::path path_;
  SimpleMapBuilder builder_;
};

class SceneMap : public MapFile
{
 public:
  explicit SceneMap(std::filesystem::path path) : path_(std::move(path)) {}
  void add(const Keyframe& keyframe) override
  {
    builder_.addKeyframe(keyframe);
    poses_.push_back({keyframe.stamp, keyframe.map_T_body});
  }
  void close() override
  {
    builder_.addPath(poses_);
    writeScene(path_, *builder_.finished());
  }

 private:
  std::filesystem::path path_;
  SceneBuilder builder_;
  Trajectory poses_;
};

class OctoMap : public MapFile
{
 public:
  OctoMap(std::filesystem::path binary, std::filesystem::path full, const OctoMapOptions& options,
          const std::vector<MountedLidar>& lidars)
    : binary_(std::move(binary)), full_(std::move(full)), builder_(options, posesOf(lidars))
  {
  }
  void add(const Keyframe& keyframe) override { builder_.add(keyframe); }
  void close() override { std::move(builder_).write(binary_, full_); }

 private:
  std::filesystem::path binary_, full_;
  OctoMapBuilder builder_;
};

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

std::vector<std::unique_ptr<MapFile>> makeMapFiles(const Paths& paths, const std::vector<MountedLidar>& lidars,
                                                   const OctoMapOptions& options)
{
  std::vector<std::unique_ptr<MapFile>> files;
  for (const std::string& ending : CloudWriter::endings())
    if (const auto cloud = withEnding(paths, ending); !cloud.empty())
      files.push_back(std::make_unique<CloudMap>(cloud));
  if (const auto keyframes = withEnding(paths, ".simplemap"); !keyframes.empty())
    files.push_back(std::make_unique<SimpleMap>(keyframes, lidars));
  if (const auto scene = withEnding(paths, ".3Dscene"); !scene.empty())
    files.push_back(std::make_unique<SceneMap>(scene));
  const auto binary = withEnding(paths, ".bt"), full = withEnding(paths, ".ot");
  if (!binary.empty() || !full.empty()) files.push_back(std::make_unique<OctoMap>(binary, full, options, lidars));
  return files;
}
}  // namespace scanloom
