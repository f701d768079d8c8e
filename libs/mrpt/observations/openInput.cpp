#include "mrpt/observations/openInput.h"

#include "base/core/ConfigError.h"
#include "input/rig/CloudsInput.h"
#include "input/rig/ReadAhead.h"
#include "input/rig/openRig.h"
#include "mrpt/observations/RawlogInput.h"

namespace scanloom
{
namespace
{
std::unique_ptr<SensorInput> openHere(const InputSource& source)
{
  if (!source.rawlog.empty()) return std::make_unique<RawlogInput>(source.rawlog, source.lidars_of_rawlog);
  if (!source.clouds.empty()) return std::make_unique<CloudsInput>(source.clouds);
  return openRig(source.rig);
}
}  // namespace

InputSource sourceOf(const RecordingFiles& files, const Configuration& configuration,
                     const std::vector<std::string>& lidars)
{
  InputSource source;
  if (!files.rawlogs.empty())
  {
    source.rawlog = files.rawlogs.front();
    source.lidars_of_rawlog = lidars;
    return source;
  }
  if (!files.clouds.empty() && !lidars.empty())
    throw UsageError("clouds do not tell lidars apart: all lidars are used");
  source.clouds = files.clouds;
  if (!source.clouds.empty()) return source;
  const RigSettings settings = readRigSettings(configuration, rigSection(configuration));
  source.rig = makeRig(settings, lidars);
  source.driver = settings.driver;
  return source;
}

std::unique_ptr<SensorInput> openInput(const InputSource& source)
{
  std::unique_ptr<SensorInput> input = openHere(source);
  return source.isLive() ? std::move(input) : std::make_unique<ReadAhead>(std::move(input));
}
}  // namespace scanloom
