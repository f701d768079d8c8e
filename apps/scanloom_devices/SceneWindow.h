#pragma once
#include "Devices.h"

#include <mrpt/gui/CDisplayWindow3D.h>

#include <string>

namespace scanloom
{
/** Shows a scene from where its camera is. */
class SceneWindow : public Window
{
 public:
  /** Throws std::runtime_error if there is no display. */
  SceneWindow(const std::string& title, const MrptScene::Ptr&, int width, int height);

  /** False, too, once a key was pressed. */
  bool isOpen() override { return window_.isOpen() && !window_.keyHit(); }

 private:
  mrpt::gui::CDisplayWindow3D window_;
};
}  // namespace scanloom
