/** A raster image to draw on, without a display or OpenGL. */
#pragma once
#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
using Color = Eigen::Array3f;  // red, green, blue in [0, 1]

class Canvas
{
 public:
  Canvas(int width, int height, const Color& background);

  int width() const { return width_; }
  int height() const { return height_; }

  /** In pixels from the upper left corner, x to the right, y downwards. What lies outside is not drawn. */
  void blend(int x, int y, const Color&, float opacity);
  void fillRectangle(int x, int y, int width, int height, const Color&);
  void disc(const Eigen::Vector2d& centre, double radius, const Color&);

  /** With antialiased edges and round ends. */
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width, const Color&);

  enum class Font
  {
    Small,  // 6 x 13 pixels a character
    Large,  // 9 x 15
  };

  /** Drawn on top of everything else. */
  void text(int x, int y, std::string, Font, const Color&);
  static int textWidth(const std::string&, Font);

  /** Throws std::runtime_error if it cannot be written. */
  void savePng(const std::filesystem::path&) const;

 private:
  struct Label
  {
    int x, y;
    std::string text;
    Font font;
    Color color;
  };

  int width_, height_;
  std::vector<Color> pixels_;  // row by row
  std::vector<Label> labels_;
};
}  // namespace scanloom
