/** The windows of a display and the drivers of IMUs, both MRPT's. */
#pragma once
#include "base/config/Configuration.h"
#include "input/rig/SensorInput.h"
#include "mrpt/maps/MrptScene.h"

#include <memory>
#include <string>

namespace scanloom
{
/** Open until a person closes it, or it is deleted. */
class Window
{
 public:
  virtual ~Window() = default;
  virtual bool isOpen() = 0;
};

/**
 * What libscanloom_devices.so can do. With it come half of MRPT's libraries, which take 0.2 s to load and 48 MB of
 * memory (doc/performance.md): only verbs that show a window or listen to a driver load it.
 */
class Devices
{
 public:
  virtual ~Devices() = default;

  /** A window of a scene that does not change. Closes at a key, too. Throws std::runtime_error if there is no display.
   */
  virtual std::unique_ptr<Window> showScene(const std::string& title, const MrptScene::Ptr&, int width,
                                            int height) const = 0;

  /** The lidars' events with samples of the IMU whose driver the section describes: see ImuDriverInput.h. */
  virtual std::unique_ptr<SensorInput> addImu(std::unique_ptr<SensorInput> lidars, const Configuration&,
                                              const std::string& section_of_imu) const = 0;
};

/** Loaded by the first call. Throws std::runtime_error if it cannot be. */
const Devices& devices();
}  // namespace scanloom
