#include "base/formats/Canvas.h"

#include "base/core/OutputFile.h"

#include <fmt/format.h>
#include <mrpt/img/CImage.h>
#include <mrpt/version.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
std::uint8_t toByte(float share) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.F, 1.F))); }

mrpt::img::TColor toMrpt(const Color& c) { return {toByte(c[0]), toByte(c[1]), toByte(c[2])}; }

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& from, const Eigen::Vector2d& to)
{
  const Eigen::Vector2d along = to - from;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0 ? std::clamp((p - from).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - from - share * along).norm();
}
// MRPT 3 takes pixels with their channels side by side, MRPT 2 a picture for each channel.
#if MRPT_VERSION >= 0x030000
mrpt::img::CImage imageOf(const std::vector<Color>& pixels, int width, int height)
{
  std::vector<std::uint8_t> bytes;
  for (const Color& pixel : pixels)
    for (const float channel : pixel) bytes.push_back(toByte(channel));
  mrpt::img::CImage image;
  image.loadFromMemoryBuffer(width, height, mrpt::img::CH_RGB, bytes.data());
  return image;
}

void textOut(mrpt::img::CImage& image, int x, int y, const std::string& text, const mrpt::img::TColor& color)
{
  image.textOut({x, y}, text, color);
}
#else
mrpt::img::CImage imageOf(const std::vector<Color>& pixels, int width, int height)
{
  std::array<std::vector<std::uint8_t>, 3> channels;
  for (const Color& pixel : pixels)
    for (int channel = 0; channel < 3; ++channel) channels[channel].push_back(toByte(pixel[channel]));
  mrpt::img::CImage image;
  image.loadFromMemoryBuffer(width, height, width, channels[0].data(), channels[1].data(), channels[2].data());
  return image;
}

void textOut(mrpt::img::CImage& image, int x, int y, const std::string& text, const mrpt::img::TColor& color)
{
  image.textOut(x, y, text, color);
}
#endif
}  // namespace

Canvas::Canvas(int width, int height, const Color& background)
  : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height, background)
{
}

void Canvas::blend(int x, int y, const Color& color, float opacity)
{
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  Color& pixel = pixels_[static_cast<std::size_t>(y) * width_ + x];
  pixel = pixel * (1 - opacity) + color * opacity;
}

void Canvas::fillRectangle(int x, int y, int width, int height, const Color& color)
{
  for (int row = y; row < y + height; ++row)
    for (int column = x; column < x + width; ++column) blend(column, row, color, 1);
}

void Canvas::disc(const Eigen::Vector2d& centre, double radius, const Color& color)
{
  line(centre, centre, 2 * radius, color);
}

void Canvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width, const Color& color)
{
  const Eigen::Array2d lowest = from.array().min(to.array()) - width;
  const Eigen::Array2d highest = from.array().max(to.array()) + width;
  for (int y = std::max(0, static_cast<int>(lowest.y())); y <= std::min<double>(height_ - 1, highest.y()); ++y)
    for (int x = std::max(0, static_cast<int>(lowest.x())); x <= std::min<double>(width_ - 1, highest.x()); ++x)
    {
      const double inside = width / 2 + 0.5 - distanceToSegment({x, y}, from, to);
      blend(x, y, color, static_cast<float>(std::clamp(inside, 0.0, 1.0)));
    }
}

void Canvas::text(int x, int y, std::string text, Font font, const Color& color)
{
  labels_.push_back({x, y, std::move(text), font, color});
}

int Canvas::textWidth(const std::string& text, Font font)
{
  return static_cast<int>(text.size()) * (font == Font::Small ? 6 : 9);
}

void Canvas::savePng(const std::filesystem::path& path) const
{
  mrpt::img::CImage image = imageOf(pixels_, width_, height_);
  for (const Label& label : labels_)
  {
    image.selectTextFont(label.font == Font::Small ? "6x13" : "9x15");
    textOut(image, label.x, label.y, label.text, toMrpt(label.color));
  }
  OutputFile file(path);
  if (!image.saveToFile(file.temporary().string()))
    throw std::runtime_error(fmt::format("{}: cannot be written", path.string()));
  file.commit();
}
}  // namespace scanloom
