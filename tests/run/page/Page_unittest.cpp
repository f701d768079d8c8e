/** The page in Chromium, by what it shows and draws. Skipped, saying so, where chromium or three.js is missing. */
#include "run/page/LiveServer.h"
#include "run/page/SiteServer.h"
#include "run/page/internal/LiveFeed.h"
#include "support/TemporaryFolder.h"
#include "support/runProgram.h"

#include <gmock/gmock.h>
#include <mrpt/img/CImage.h>

#include <cmath>
#include <fstream>
#include <thread>

namespace scanloom::page_unittest
{
namespace
{
using testing::HasSubstr;

#define SCANLOOM_NEEDS_CHROMIUM                                             \
  if (runProgram("command -v chromium && command -v python3").status != 0)  \
    GTEST_SKIP() << "chromium or python3 is not installed";                 \
  if (!std::filesystem::exists("/usr/share/javascript/three/three.min.js")) \
  GTEST_SKIP() << "three.js is not installed (libjs-three)"

constexpr std::uint8_t kLeft = 0, kRight = 1;

/** A ring of points on each side of the machine. */
void addLidar(Scan& scan, std::uint8_t lidar)
{
  constexpr int kColumns = 200, kBeams = 10;
  for (int i = 0; i < kColumns; ++i)
  {
    const auto first = static_cast<std::uint32_t>(scan.points.size());
    scan.columns.push_back({scan.start + i * scan.period / kColumns, first, kBeams, {}, {}, lidar});
    scan.points.resize(first + kBeams);
    for (int k = 0; k < kBeams; ++k)
    {
      const double angle = 2 * M_PI * i / kColumns;
      const std::size_t p = first + static_cast<std::size_t>(k);
      scan.points.x[p] = static_cast<float>(5 * std::cos(angle));
      scan.points.y[p] = static_cast<float>((lidar == kLeft ? 6 : -6) + 5 * std::sin(angle));
      scan.points.z[p] = static_cast<float>(0.3 * k);
      scan.points.sensor_id[p] = lidar;
    }
  }
}

const RegistrationResult& openAhead()
{
  static const RegistrationResult result = []
  {
    RegistrationResult open;
    open.degenerate_directions = {Vector6d::Unit(0)};
    return open;
  }();
  return result;
}

StateEstimate estimateAt(Timestamp stamp, double x, Health health)
{
  StateEstimate estimate;
  estimate.stamp = stamp;
  estimate.map_T_body.translation.x() = x;
  estimate.health = health;
  estimate.registration = openAhead();
  return estimate;
}

/** 60000 points a quarter of a metre apart, each number at a height of its own. */
Keyframe crowdedKeyframe(Timestamp stamp, int number)
{
  Keyframe keyframe{stamp, Rigid::identity(), {}};
  constexpr std::size_t kRows = 200, kPoints = 60000;
  keyframe.points.resize(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i)
  {
    keyframe.points.x[i] = 0.25F * static_cast<float>(i / kRows) - 30;
    keyframe.points.y[i] = 0.25F * static_cast<float>(i % kRows) - 25;
    keyframe.points.z[i] = 0.25F * static_cast<float>(number);
  }
  return keyframe;
}

/** A machine that drives ahead in real time, until it is destroyed. At an event mark its right lidar stops; in a crowd,
 * all. */
class Drive
{
 public:
  std::atomic<Health> health{Health::Ok};

  explicit Drive(int crowded_keyframes = 0)
    : crowded_keyframes_(crowded_keyframes),
      server_({SensorAddress::parse("127.0.0.1").ip, 0}, exchange_),
      thread_([this] { drive(); })
  {
  }
  ~Drive()
  {
    ended_ = true;
    thread_.join();
  }

  std::string url() const { return server_.url(); }

 private:
  void drive()
  {
    RecordingHeader header;
    header.lidars.resize(2);
    header.lidars[kLeft].name = "left";
    header.lidars[kRight].name = "right";
    header.lidars[kLeft].beams = header.lidars[kRight].beams = 10;
    LiveFeed feed(exchange_, {"slam", true, true});
    bool right_sends = true;
    for (int i = 0; !ended_; ++i, std::this_thread::sleep_for(100ms))
    {
      if (!right_sends && crowded_keyframes_ > 0) continue;
      Scan scan;
      scan.start = fromNanoseconds(1000000000LL * 1000 + 100000000LL * i);
      scan.period = 100ms;
      addLidar(scan, kLeft);
      if (feed.takeMark()) right_sends = false;
      if (right_sends) addLidar(scan, kRight);
      feed.add(scan, header);
      StateEstimate estimate = estimateAt(scan.end(), 0.1 * i, health);
      if (i < crowded_keyframes_)
        estimate.keyframe = crowdedKeyframe(estimate.stamp, i);
      else if (i % 10 == 0)
        estimate.keyframe = Keyframe{estimate.stamp, estimate.map_T_body, scan.points};
      feed.add(estimate);
      feed.update({}, {0.1 * i, 0.02 * i});
      feed.offer();
    }
  }

  int crowded_keyframes_;
  LiveExchange exchange_;
  LiveServer server_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

struct Seen
{
  std::string text;
  mrpt::img::CImage picture;
};

Seen look(const std::string& url, const std::string& text, const std::string& script = "")
{
  const TemporaryFolder folder;
  const std::string picture = (folder / "page.png").string();
  const Ended ended =
      runProgram(fmt::format("timeout 600 python3 {}/tests/run/page/look.py '{}' 1280x800 {} 100 \"{}\" '{}' 2>&1",
                             SCANLOOM_SOURCE_DIR, url, picture, text, script));
  Seen seen;
  seen.text = ended.output;
  if (!seen.picture.loadFromFile(picture)) seen.text += "\nno picture";
  return seen;
}

/** Number of the picture's pixels that are nearly of this colour. */
int pixelsLike(const mrpt::img::CImage& picture, int red, int green, int blue)
{
  int count = 0;
  for (unsigned y = 0; y < picture.getHeight(); ++y)
    for (unsigned x = 0; x < picture.getWidth(); ++x)
    {
      const auto* bgr = picture.ptr<std::uint8_t>(x, y);
      count += std::abs(bgr[0] - blue) + std::abs(bgr[1] - green) + std::abs(bgr[2] - red) < 12;
    }
  return count;
}
}  // namespace

TEST(Page, drawsThePathAndTheScanInTheLidarsColours)
{
  SCANLOOM_NEEDS_CHROMIUM;
  Drive drive;
  std::this_thread::sleep_for(3s);
  const Seen seen = look(drive.url() + "/?theme=dark&colour=lidar", "OK");
  EXPECT_THAT(seen.text, HasSubstr("left"));
  EXPECT_GT(pixelsLike(seen.picture, 0x0a, 0x7c, 0xff), 300) << "left";
  EXPECT_GT(pixelsLike(seen.picture, 0xff, 0x7a, 0x00), 300) << "right";
  EXPECT_GT(pixelsLike(seen.picture, 0xc8, 0x00, 0xc8), 30) << "path";
}

TEST(Page, namesWhatIsWrong)
{
  SCANLOOM_NEEDS_CHROMIUM;
  Drive drive;
  drive.health = Health::Lost;
  EXPECT_THAT(look(drive.url(), "LOST").text, HasSubstr("LOST"));
  drive.health = Health::Degenerate;
  const std::string said = look(drive.url(), "DEGENERATE").text;
  EXPECT_THAT(said, HasSubstr("DEGENERATE"));
  EXPECT_THAT(said, HasSubstr("open ahead"));
}

TEST(Page, aLidarThatStopsIsNamed)
{
  SCANLOOM_NEEDS_CHROMIUM;
  Drive drive;
  // The mark stops the right lidar (Drive); what is printed is how long the page takes to say so.
  const Seen seen = look(drive.url(), "OK", R"js((async () => {
    const begin = performance.now();
    await fetch("/mark", { method: "POST", body: "stop" });
    const says = () => document.body.innerText.includes("right\u0027 sends nothing");
    while (!says() && performance.now() < begin + 60000) await new Promise((resume) => setTimeout(resume, 20));
    return says() ? "named after " + ((performance.now() - begin) / 1000).toFixed(1) + " s" : "not named";
  })())js");
  const std::size_t at = seen.text.find("named after ");
  ASSERT_NE(at, std::string::npos) << seen.text;
  std::cout << seen.text.substr(at) << '\n';
}

TEST(Page, drawsAMillionPointsOrAsManyAsItCanInTime)
{
  SCANLOOM_NEEDS_CHROMIUM;
  Drive drive(16);
  // Waits for all points, then turns the wheel to and fro for five seconds, so that each frame is drawn; then waits for
  // the picture of the machine at rest.
  const Seen seen = look(drive.url() + "/?camera=top", "OK", R"js((async () => {
    const data = document.body.dataset, canvas = document.getElementById("canvas");
    const pause = (ms) => new Promise((resume) => setTimeout(resume, ms));
    for (let i = 0; i < 3000 && Number(data.points) < 950000; ++i) await pause(100);
    await fetch("/mark", { method: "POST", body: "stop" });
    let turn = 0;
    const turning = setInterval(() => canvas.dispatchEvent(new WheelEvent("wheel", { deltaY: ++turn % 2 ? 1 : -1 })), 5);
    await pause(2000);
    const before = Number(data.frames), begin = performance.now();
    await pause(5000);
    const frames_per_second = 1000 * (data.frames - before) / (performance.now() - begin), drawn = data.drawn;
    clearInterval(turning);
    for (let i = 0; i < 600 && Number(data.drawn) < 800000; ++i) await pause(100);
    return "points=" + data.points + " at_rest=" + data.drawn + " moving=" + drawn + " frames_per_second=" +
           frames_per_second.toFixed(1);
  })())js");
  const std::size_t at = seen.text.find("points=");
  ASSERT_NE(at, std::string::npos) << seen.text;
  int points = 0, at_rest = 0;
  ASSERT_EQ(std::sscanf(seen.text.c_str() + at, "points=%d at_rest=%d", &points, &at_rest), 2);
  std::cout << seen.text.substr(at) << '\n';
  EXPECT_GE(points, 950000);
  EXPECT_GE(at_rest, 800000) << "all but what the camera does not see";
}

TEST(Page, showsASitesDrivesLoopsReferencesAndWhatIsGone)
{
  SCANLOOM_NEEDS_CHROMIUM;
  const TemporaryFolder site;
  std::filesystem::create_directories(site / "drives");
  std::ofstream(site / "site.json")
      << R"({"drives": [{"name": "a, b", "pieces": [{"piece": 1, "begin_ns": 0, "end_ns": 9000000000}]}], "tiles": [],
             "tile_edge": 51.2, "pieces": [{}], "coordinates_less": [0, 0, 0]})";
  std::ofstream(site / "drives" / "a, b.tum") << "1 0 0 0 0 0 0 1\n2 40 0 0 0 0 0 1\n";
  std::ofstream(site / "loops.csv") << "from_drive,from_stamp_ns,to_drive,to_stamp_ns,decision\n"
                                       "\"a, b\",1000000000,\"a, b\",2000000000,accepted\n"
                                       "\"a, b\",1000000000,\"a, b\",2000000000,look alike\n";
  std::ofstream(site / "references.csv") << "x,y,z,used,residual_x,residual_y,residual_z\n1,2,3,1,0.03,0,0.04\n";
  std::ofstream(site / "gone.csv") << "x,y,z,height,width,gone_by\n20,5,0,8.2,0.4,\"a, b\"\n";
  const SiteServer server({SensorAddress::parse("127.0.0.1").ip, 0}, site.path());
  const std::string said = look(server.url() + "/?theme=light", "0 tiles").text;
  EXPECT_THAT(said, HasSubstr("a, b\n2 poses"));
  EXPECT_THAT(said, HasSubstr("accepted\n1"));
  EXPECT_THAT(said, HasSubstr("look alike\n1"));
  EXPECT_THAT(said, HasSubstr("0.050 m"));
  EXPECT_THAT(said, HasSubstr("8.2 m high at 20, 5: a, b saw through it"));
}
}  // namespace scanloom::page_unittest
