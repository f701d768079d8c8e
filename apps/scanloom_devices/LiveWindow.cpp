#include "LiveWindow.h"

#include "LiveScene.h"
#include "requireDisplay.h"
#include "run/page/LiveMap.h"
#include "run/page/yieldToAll.h"

#include <fmt/format.h>
#include <mrpt/gui/CDisplayWindow3D.h>
#include <mrpt/gui/keycodes.h>

#include <cctype>
#include <utility>

namespace scanloom
{
namespace
{
constexpr auto kDrawEvery = 100ms;
constexpr std::size_t kBytesAtOnce = 1 << 20;
constexpr double kSkip = 5;  // s
constexpr const char* kKeysOfARun = "F: follow or not   M: mark an event   Q: close";
constexpr const char* kKeysOfAPlayer =
    "Space: play or pause   S: step   + -: speed   left right: 5 s   F: follow or not   Q: close";

/** As on the page. */
mrpt::img::TColorf colourOf(const std::string& word)
{
  if (word == "OK" || word == "RUNNING" || word == "PLAYING") return {0.3F, 1.0F, 0.4F};
  if (word == "DEGENERATE" || word == "INITIALISING") return {1.0F, 0.7F, 0.1F};
  if (word == "LOST" || word == "SILENT") return {1.0F, 0.35F, 0.35F};
  return {1.0F, 1.0F, 1.0F};
}

std::vector<std::string> linesOf(const ViewStatus& status)
{
  const auto now = std::chrono::steady_clock::now();
  std::vector<std::string> lines{status.why};
  for (const ViewedLidar& lidar : status.lidars)
  {
    const double silence = silenceOf(lidar, status, now);
    lines.push_back(fmt::format("{}: {}{} lost{}", lidar.name,
                                status.player ? "" : fmt::format("{:.0f}/s, ", lidar.rate), lidar.lost,
                                silence > kSilent ? fmt::format(", silent for {:.1f} s", silence) : ""));
  }
  if (status.poses > 0) lines.push_back(fmt::format("{:.1f} m, {:.1f} m/s", status.distance, status.speed));
  if (status.factor) lines.push_back(fmt::format("{:.1f} times real time", *status.factor));
  if (const auto& player = status.player)
    lines.push_back(fmt::format("{:.1f} of {:.1f} s, speed {:g}", player->position, player->length, player->speed));
  for (std::size_t i = 0; i < status.warnings.size() && i < 3; ++i)
    lines.push_back(fmt::format("warning ({}): {}", status.warnings[i].count, status.warnings[i].text));
  return lines;
}

/** What a key asks of a player; empty if nothing. */
std::string commandOf(int key, const PlayerStatus& player)
{
  using namespace mrpt::gui;
  switch (key)
  {
    case MRPTK_SPACE:
      return player.playing ? "pause" : "play";
    case 'S':
      return "step";
    case '+':
    case '=':
      return fmt::format("speed {:g}", std::min(100.0, 2 * player.speed));
    case '-':
      return fmt::format("speed {:g}", std::max(0.1, player.speed / 2));
    case MRPTK_LEFT:
      return fmt::format("seek {:.3f}", std::max(0.0, player.position - kSkip));
    case MRPTK_RIGHT:
      return fmt::format("seek {:.3f}", player.position + kSkip);
    default:
      return "";
  }
}

}  // namespace

class LiveWindow::Drawing
{
 public:
  Drawing(const std::string& title, LiveExchange& exchange) : exchange_(exchange), window_(title, 1280, 800)
  {
    window_.get3DSceneAndLock() = scene_.scene();
    window_.unlockAccess3DScene();
    window_.setCameraZoom(40);
    window_.setCameraAzimuthDeg(-120);
    window_.setCameraElevationDeg(40);
  }

  /** False once the window is closed. */
  bool update()
  {
    LiveNews news;
    ViewStatus status;
    {
      const std::lock_guard lock(exchange_.mutex);
      std::swap(news, exchange_.news);
      status = exchange_.status;
    }
    map_.add(news);
    draw(map_.lackedBy(seen_, kBytesAtOnce), status);
    return window_.isOpen() && obeyKeys(status);
  }

 private:
  void draw(const std::string& messages, const ViewStatus& status)
  {
    window_.get3DSceneAndLock();
    scene_.apply({reinterpret_cast<const std::uint8_t*>(messages.data()), messages.size()});
    window_.clearTextMessages();
    write(wordFor(status, std::chrono::steady_clock::now()), linesOf(status));
    window_.addTextMessage(8, 8, status.player ? kKeysOfAPlayer : kKeysOfARun);
    window_.unlockAccess3DScene();
    const Eigen::Vector3f& p = scene_.position();
    if (follow_) window_.setCameraPointingToPoint(p.x(), p.y(), p.z());
    window_.repaint();
  }

  /** The word large and in its colour, the lines below it. */
  void write(const std::string& word, const std::vector<std::string>& lines)
  {
    constexpr int kWord = 34, kLine = 18, kFirstLine = kWord + 6;  // pixels
    mrpt::opengl::TFontParams large;
    large.vfont_scale = 24;
    large.color = colourOf(word);
    window_.addTextMessage(8, -kWord, word, 1, large);
    for (std::size_t i = 0; i < lines.size(); ++i)
      window_.addTextMessage(8, -kFirstLine - kLine * static_cast<int>(i + 1), lines[i], i + 2);
  }

  bool obeyKeys(const ViewStatus& status)
  {
    if (!window_.keyHit()) return true;
    const int key = window_.getPushedKey();
    const int letter = key < 128 ? std::toupper(key) : key;
    if (letter == 'F') follow_ = !follow_;
    const std::string command = status.player ? commandOf(letter, *status.player) : "";
    const std::lock_guard lock(exchange_.mutex);
    if (!command.empty()) exchange_.commands.push_back(command);
    if (letter == 'M' && !status.player) exchange_.marks.push_back("marked in the window");
    return letter != 'Q';
  }

  LiveExchange& exchange_;
  mrpt::gui::CDisplayWindow3D window_;
  LiveScene scene_;
  LiveMap map_;
  SeenByPage seen_;
  bool follow_ = true;
};

LiveWindow::LiveWindow(const std::string& title, LiveExchange& exchange, Devices::Priority priority)
{
  requireDisplay("use --web");
  drawing_ = std::make_unique<Drawing>(title, exchange);  // by this thread: one that yields may be too late for MRPT
  thread_ = std::thread([this, priority] { show(priority); });
}

LiveWindow::~LiveWindow()
{
  stopping_ = true;
  thread_.join();
}

void LiveWindow::show(Devices::Priority priority)
{
  if (priority == Devices::Priority::BelowAll) yieldToAll();
  while (!stopping_ && drawing_->update()) std::this_thread::sleep_for(kDrawEvery);
  open_ = false;
}
}  // namespace scanloom
