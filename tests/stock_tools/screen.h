/** What a program with windows shows, on a display that exists in memory only. */
#pragma once
#include "stockTool.h"
#include "support/ChildProcess.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace scanloom
{
inline constexpr std::size_t kPixelsOfTheScreen = 1280 * 960;

struct Color8
{
  std::uint8_t red, green, blue;
};

/** Xvfb, which keeps its screen in a file: XWD, 32 bits a pixel. */
class VirtualScreen
{
 public:
  explicit VirtualScreen(const TemporaryFolder& folder)
    : file_(folder / "Xvfb_screen0"),
      server_("Xvfb " + name() + " -screen 0 1280x960x24 -fbdir " + folder.path().string(), folder / "xvfb.txt")
  {
    while (!std::filesystem::exists(file_) && waited_ < kPatience) wait();
  }
  ~VirtualScreen()
  {
    server_.send(SIGTERM);
    server_.wait();
  }
  VirtualScreen(const VirtualScreen&) = delete;
  VirtualScreen& operator=(const VirtualScreen&) = delete;

  /** By the process, so that tests side by side do not meet. */
  std::string name() const { return ":" + std::to_string(100 + getpid() % 30000); }

  /** Until enough pixels satisfy the condition; @return how many did at last. */
  std::size_t waitForPixels(const std::function<bool(Color8)>& condition, std::size_t enough)
  {
    std::size_t count = 0;
    for (; waited_ < kPatience; wait())
    {
      const std::vector<Color8> all = pixels();
      count = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), condition));
      if (count >= enough) break;
    }
    return count;
  }

 private:
  static constexpr int kPatience = 300;  // tenths of a second

  void wait()
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    ++waited_;
  }

  std::vector<Color8> pixels() const
  {
    const std::string content = contentOf(file_);
    const auto word = [&](std::size_t i)  // XWDFileHeader, big-endian
    {
      std::uint32_t value = 0;
      for (std::size_t byte = 0; byte < 4; ++byte)
        value = value << 8 | static_cast<std::uint8_t>(content[4 * i + byte]);
      return std::size_t{value};
    };
    if (content.size() < 100) return {};
    const std::size_t header = word(0), colors = word(19), bytes = word(5) * word(12);
    const std::size_t first = header + 12 * colors;
    if (content.size() < first + bytes) return {};
    std::vector<Color8> result;
    for (std::size_t i = first; i + 4 <= first + bytes; i += 4)
      result.push_back({static_cast<std::uint8_t>(content[i + 2]), static_cast<std::uint8_t>(content[i + 1]),
                        static_cast<std::uint8_t>(content[i])});
    return result;
  }

  std::filesystem::path file_;
  ChildProcess server_;
  int waited_ = 0;
};
}  // namespace scanloom
