#include "lab/simulation/ScenePictures.h"

#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <tbb/global_control.h>

namespace scanloom::scene_pictures_unittest
{
namespace
{
/** A machine at rest on bare ground. */
Scene bareScene()
{
  SimulationSettings settings;
  settings.drive.route = "work";
  settings.drive.speed_up = 1;
  settings.drive.duration = 1;
  settings.forest.stand.stems_per_hectare = settings.forest.stand.stumps_per_hectare = 0;
  settings.forest.foliage.undergrowth_cover = 0;
  settings.objects.felled_trees = false;
  settings.ranging.range_noise = settings.ranging.range_noise_weak = 0;
  return makeScene(settings, 1);
}

struct Pixel
{
  int red, green, blue;
};

Pixel pixelOf(const mrpt::img::CImage& image, unsigned x, unsigned y)
{
  const auto* bgr = image.ptr<std::uint8_t>(x, y);
  return {bgr[2], bgr[1], bgr[0]};
}
}  // namespace

TEST(ScenePictures, showTheMachineBetweenGroundAndSky)
{
  const TemporaryFolder folder;
  drawStand(bareScene(), 0.5, folder / "stand.png");

  mrpt::img::CImage image;
  ASSERT_TRUE(image.loadFromFile((folder / "stand.png").string()));
  const Pixel sky = pixelOf(image, 600, 20), ground = pixelOf(image, 100, 600), machine = pixelOf(image, 450, 480);
  EXPECT_GT(sky.blue, sky.red);
  EXPECT_GT(ground.red, ground.blue);
  EXPECT_LT(ground.red, 180);
  EXPECT_GT(machine.red, 2 * machine.blue) << "yellow";
}

TEST(ScenePictures, showATurnOfEachLidarAsItLooksAround)
{
  const TemporaryFolder folder;
  drawScans(bareScene(), 0.2, folder / "scans.png");

  mrpt::img::CImage image;
  ASSERT_TRUE(image.loadFromFile((folder / "scans.png").string()));
  EXPECT_EQ(image.getWidth(), 1200U);
  const unsigned strip = 26 + 192;
  ASSERT_EQ(image.getHeight(), 2 * strip + 26);
  for (const unsigned top : {26U, 26U + strip})
  {
    const Pixel up = pixelOf(image, 600, top + 3), down = pixelOf(image, 600, top + 150);
    EXPECT_TRUE(up.red == up.green && up.green == up.blue) << "no return from the sky";
    EXPECT_GT(down.green, down.red + 20) << "the ground near by";
  }
}

TEST(ScenePictures, areTheSameForAnyNumberOfThreads)
{
  const TemporaryFolder folder;
  const Scene scene = bareScene();
  drawStand(scene, 0.5, folder / "a.png");
  drawScans(scene, 0.2, folder / "b.png");
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  drawStand(scene, 0.5, folder / "c.png");
  drawScans(scene, 0.2, folder / "d.png");
  EXPECT_EQ(contentOf(folder / "a.png"), contentOf(folder / "c.png"));
  EXPECT_EQ(contentOf(folder / "b.png"), contentOf(folder / "d.png"));
}
}  // namespace scanloom::scene_pictures_unittest
