#pragma once
#include "Devices.h"

#include <atomic>
#include <memory>
#include <string>
#include <thread>

namespace scanloom
{
/**
 * A window that shows what a LiveFeed hands over: the path, the newest scan in the lidars' colours, the map by height,
 * and the health. The working thread waits for nothing; the scene is made by a thread of its own, and drawn by MRPT's
 * at the usual priority.
 *
 * Keys: Space plays or pauses, S steps, + and - change the speed, the arrows left and right go back and on by 5 s
 * (where a recording is played), F follows the machine or not, M marks an event, Q closes the window.
 */
class LiveWindow : public Window
{
 public:
  /** Throws std::runtime_error if there is no display. */
  LiveWindow(const std::string& title, LiveExchange&, Devices::Priority);
  ~LiveWindow() override;
  LiveWindow(const LiveWindow&) = delete;
  LiveWindow& operator=(const LiveWindow&) = delete;

  /** False once a person has closed it. */
  bool isOpen() override { return open_; }

 private:
  class Drawing;

  void show(Devices::Priority);

  std::unique_ptr<Drawing> drawing_;
  std::atomic<bool> open_{true}, stopping_{false};
  std::thread thread_;
};
}  // namespace scanloom
