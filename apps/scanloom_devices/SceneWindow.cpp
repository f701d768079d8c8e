#include "SceneWindow.h"

#include <cstdlib>
#include <stdexcept>

namespace scanloom
{
namespace
{
void requireDisplay()
{
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY"))
    throw std::runtime_error("there is no display for a window: use --png FILE, which needs none");
}
}  // namespace

SceneWindow::SceneWindow(const std::string& title, const MrptScene::Ptr& scene, int width, int height)
  : window_((requireDisplay(), title), static_cast<unsigned>(width), static_cast<unsigned>(height))
{
  const viz::CCamera camera = scene->getViewport()->getCamera();
  window_.get3DSceneAndLock() = scene;
  window_.unlockAccess3DScene();
  window_.setCameraPointingToPoint(camera.getPointingAtX(), camera.getPointingAtY(), camera.getPointingAtZ());
  window_.setCameraZoom(camera.getZoomDistance());
  window_.setCameraAzimuthDeg(camera.getAzimuthDegrees());
  window_.setCameraElevationDeg(camera.getElevationDegrees());
  window_.repaint();
}
}  // namespace scanloom
