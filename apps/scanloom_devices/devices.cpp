/** libscanloom_devices.so: what apps/scanloom/Devices.h promises. */
#include "Devices.h"
#include "SceneWindow.h"
#include "mrpt/sensors/ImuDriver.h"
#include "mrpt/sensors/ImuDriverInput.h"

#include <mrpt/config/CConfigFileMemory.h>

#include <utility>

namespace scanloom
{
namespace
{
class MrptDevices : public Devices
{
 public:
  std::unique_ptr<Window> showScene(const std::string& title, const MrptScene::Ptr& scene, int width,
                                    int height) const override
  {
    return std::make_unique<SceneWindow>(title, scene, width, height);
  }

  std::unique_ptr<SensorInput> addImu(std::unique_ptr<SensorInput> lidars, const Configuration& configuration,
                                      const std::string& section) const override
  {
    mrpt::config::CConfigFileMemory as_mrpt;
    for (const std::string& key : configuration.keys(section))
      as_mrpt.write(section, key, configuration.text(section, key));
    return std::make_unique<ImuDriverInput>(std::move(lidars), std::make_unique<ImuDriver>(as_mrpt, section));
  }
};
}  // namespace
}  // namespace scanloom

extern "C" const scanloom::Devices* scanloomDevices()
{
  static const scanloom::MrptDevices devices;
  return &devices;
}
