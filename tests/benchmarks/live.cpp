/**
 * Live input measured over the loopback interface: how late scans come, what the threads cost, whether anything is
 * lost, whether memory grows. Lidars are OS-128, 1024x10, RNG19 (24.8 kB a packet), simulated by a process of their
 * own.
 *
 *   scanloom_bench_live --sensors 8 --seconds 120             latency
 *   scanloom_bench_live --sensors 8 --seconds 600 --speed 3   a soak
 *   scanloom_bench_live --sensors 2 --seconds 600 --busy 4    with all cores under stress
 *   scanloom_bench_live --sensors 2 --rawlog /tmp/live.rawlog  written to disk, as `record` does
 *   scanloom_bench_live --sensors 2 --web --pages 4           shown on pages (PageReaders)
 *   scanloom_bench_live --sensors 2 --ros2                    published on /bench/points, as `record --ros2` does
 *   scanloom_bench_live --spoofed 10 --flood 1000             with strangers, without configured addresses
 */
#include "LoopbackLidars.h"
#include "PageReaders.h"
#include "input/rig/internal/RigLive.h"
#include "mrpt/observations/RawlogWriter.h"
#include "mrpt/observations/RigObservations.h"
#include "run/page/WatchedInput.h"
#include "run/topics/RosTopics.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace
{
using namespace scanloom;
using namespace scanloom::bench;

struct Arguments
{
  LoopbackOptions loopback;
  double scan_rate = 10;
  double deadline_ms = 5;
  int busy = 0;
  bool web = false;
  int pages = 0;
  bool ros2 = false;
  std::string rawlog;  // empty: none
  int compression_level = 0;
};

/** Processes that do nothing but use the processor. */
class BusyProcesses
{
 public:
  explicit BusyProcesses(int count)
  {
    for (int i = 0; i < count; ++i)
    {
      processes_.push_back(fork());
      volatile std::uint64_t turns = 0;
      while (processes_.back() == 0) turns = turns + 1;
    }
  }
  BusyProcesses(const BusyProcesses&) = delete;
  BusyProcesses& operator=(const BusyProcesses&) = delete;
  ~BusyProcesses()
  {
    for (const pid_t process : processes_)
    {
      kill(process, SIGKILL);
      waitpid(process, nullptr, 0);
    }
  }

 private:
  std::vector<pid_t> processes_;
};

struct Percentiles
{
  double p50, p99, p999, most;
};

/** In ms. */
Percentiles percentilesOf(std::vector<Duration> values)
{
  std::sort(values.begin(), values.end());
  const auto at = [&](double share)
  { return 1e3 * seconds(values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))]); };
  if (values.empty()) return {};
  return {at(0.5), at(0.99), at(0.999), at(1)};
}

void print(const char* what, const std::vector<Duration>& values)
{
  const Percentiles p = percentilesOf(values);
  fmt::print("  {:<46} p50 {:.3f}  p99 {:.3f}  p99.9 {:.3f}  max {:.3f} ms\n", what, p.p50, p.p99, p.p999, p.most);
}

double residentMegabytes()
{
  std::ifstream file("/proc/self/statm");
  double total = 0, resident = 0;
  file >> total >> resident;
  return 1e-6 * resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/** Seconds of CPU that each thread has used, by its name. */
std::map<std::string, double> cpuOfThreads()
{
  std::map<std::string, double> cpu;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task"))
  {
    std::ifstream file(task.path() / "stat");
    std::string line;
    std::getline(file, line);
    const std::size_t open = line.find('('), close = line.rfind(')');
    std::istringstream rest(line.substr(close + 2));
    std::vector<std::string> fields;  // from the third on
    for (std::string field; rest >> field;) fields.push_back(field);
    const double ticks = std::stod(fields[11]) + std::stod(fields[12]);
    cpu[line.substr(open + 1, close - open - 1)] += ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
  }
  return cpu;
}

struct Observed
{
  std::vector<Duration> after_packet, after_end;  // latencies
  std::uint64_t scans = 0, incomplete = 0, columns = 0;
  std::vector<std::pair<double, double>> memory;  // s, MB
  std::map<std::string, double> cpu;
  double elapsed = 0;
};

/** The page of a run, and its readers. */
struct ShownOnPage
{
  ShownOnPage(SensorInput& live, int pages) : input(live, feed), readers(pages, server.address()) {}

  LiveExchange exchange;
  LiveFeed feed{exchange, {"record", true, false}};
  WatchedInput input;
  LiveServer server{{SensorAddress::parse("127.0.0.1").ip, 0}, exchange};
  PageReaders readers;
};

/** The topics of a run. */
struct ShownOnTopics
{
  explicit ShownOnTopics(SensorInput& live) : input(live, topics, PublishedInput::Pace::OfInput) {}

  RosTopics topics{openRos2Node(ros2NetworkOfEnvironment(), "/bench", "live"), "/bench", false};
  PublishedInput input;
};

Observed observe(RigLive& live, SensorInput& watched, const LoopbackLidars& lidars, ShownOnPage* page,
                 RawlogWriter* writer)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  Clock::time_point looked = start;
  Observed observed;
  while (!live.ended())
  {
    const auto event = watched.next(50ms);
    const Clock::time_point came = Clock::now();
    if (page) page->feed.offer();
    if (writer && event) writer->write(*toObservation(*event, live.setup(), DriverOptions{}));
    if (writer) writer->secure();
    if (event)
    {
      if (std::holds_alternative<SensorImu>(*event)) continue;
      const Scan& scan = std::get<Scan>(*event);
      const bool cut = observed.scans == 0 || lidars.finished();
      ++observed.scans;
      observed.columns += scan.columns.size();
      observed.incomplete += !scan.complete() && !cut;
      if (!cut)
      {
        observed.after_packet.push_back(live.releaseLatency());
        observed.after_end.push_back(came.time_since_epoch() - lidars.hostTimeOf(scan.end()));
      }
    }
    const Clock::time_point now = Clock::now();
    if (now - looked >= 1s)
    {
      if (!lidars.finished())
        observed.memory.emplace_back(std::chrono::duration<double>(now - start).count(), residentMegabytes());
      looked = now;
      if (lidars.finished())
      {
        observed.cpu = cpuOfThreads();
        live.stop();
      }
    }
  }
  observed.elapsed = std::chrono::duration<double>(Clock::now() - start).count();
  return observed;
}

/** MB per hour by least squares, of the second half: the first one fills pools. */
double slopeOf(const std::vector<std::pair<double, double>>& memory)
{
  double n = 0, t = 0, m = 0, tt = 0, tm = 0;
  for (std::size_t i = memory.size() / 2; i < memory.size(); ++i)
  {
    n += 1;
    t += memory[i].first;
    m += memory[i].second;
    tt += memory[i].first * memory[i].first;
    tm += memory[i].first * memory[i].second;
  }
  return 3600 * (n * tm - t * m) / (n * tt - t * t);
}

/** Whether every block that was sent is accounted for. */
bool report(const Arguments& arguments, const LoopbackLidars& lidars, const RigLive& live, const Observed& observed)
{
  const RigAccount account = live.account();
  const double simulated = arguments.loopback.seconds * arguments.loopback.speed;
  const auto input = [&](const char* name) { return account.input.at(name); };
  const std::uint64_t lost = input("datagrams_dropped") + input("datagrams_dropped_by_kernel");
  LidarCounters sum;
  std::uint64_t of_other_senders = 0;
  bool exact = input("datagrams") + lost == lidars.sent() + lidars.sentByStrangers();
  for (const LidarAccount& lidar : account.lidars)
  {
    const LidarCounters& c = lidar.counters;
    exact &= c.received == c.emitted + c.late + c.duplicate + c.invalid + c.before_start + c.implausible + c.dropped;
    of_other_senders += lidar.of_other_senders;
    sum.packets += c.packets;
    sum.received += c.received;
    sum.emitted += c.emitted;
    sum.late += c.late;
    sum.lost += c.lost;
    sum.dropped += c.dropped;
  }
  fmt::print("{} lidars, {:.0f} s at speed {}: {:.2f} sensor-hours; {:.0f} datagrams/s, {:.0f} MB/s; scans at {} Hz\n",
             arguments.loopback.sensors, arguments.loopback.seconds, arguments.loopback.speed,
             simulated * arguments.loopback.sensors / 3600,
             static_cast<double>(lidars.sent()) / arguments.loopback.seconds,
             1e-6 * static_cast<double>(lidars.sent() * lidars.packetBytes()) / arguments.loopback.seconds,
             arguments.scan_rate);
  print("release, from the last packet's kernel stamp", observed.after_packet);
  print("release, from the scan's end", observed.after_end);
  fmt::print("  scans {}, incomplete (deadline) {}, dropped {}; columns emitted {}, in scans {}\n", observed.scans,
             observed.incomplete, input("scans_dropped"), sum.emitted, observed.columns);
  fmt::print("  datagrams sent {}, received {}, dropped by kernel {}, by ring {}; packets batched {}; restamped {}\n",
             lidars.sent(), input("datagrams"), input("datagrams_dropped_by_kernel"), input("datagrams_dropped"),
             sum.packets, input("datagrams_restamped"));
  fmt::print("  blocks received {}, emitted {}, late {}, dropped {}, lost {}\n", sum.received, sum.emitted, sum.late,
             sum.dropped, sum.lost);
  if (arguments.loopback.hasStrangers())
    fmt::print("  strangers sent {}; refused: {} packets of other senders, {} IMU samples\n", lidars.sentByStrangers(),
               of_other_senders, account.implausible_imu_samples);
  for (const auto& [name, cpu] : observed.cpu)
    fmt::print("  thread {:<16} {:5.1f} % of a core, {:.2f} us per datagram\n", name, 100 * cpu / observed.elapsed,
               1e6 * cpu / static_cast<double>(lidars.sent()));
  if (!observed.memory.empty())
    fmt::print("  memory {:.1f} MB, slope of the second half {:+.2f} MB/h\n", observed.memory.back().second,
               slopeOf(observed.memory));
  fmt::print("  accounts {}\n", exact ? "exact" : "NOT EXACT");
  return exact;
}

int run(const Arguments& arguments)
{
  LoopbackLidars lidars(arguments.loopback);
  lidars.start();
  const BusyProcesses busy(arguments.busy);
  scanloom::Rig rig = lidars.rig();
  rig.batcher.scan_rate = arguments.scan_rate;
  rig.batcher.deadline_ms = arguments.deadline_ms;
  RigLive live(rig);
  for (const std::string& warning : live.takeWarnings()) fmt::print("  warning: {}\n", warning);
  lidars.go();
  const auto page = arguments.web ? std::make_unique<ShownOnPage>(live, arguments.pages) : nullptr;
  const auto writer = arguments.rawlog.empty()
                          ? nullptr
                          : std::make_unique<RawlogWriter>(arguments.rawlog, live.setup().header,
                                                           RawlogOptions{arguments.compression_level, 1s});
  const auto topics = arguments.ros2 ? std::make_unique<ShownOnTopics>(live) : nullptr;
  SensorInput& watched = page ? page->input : topics ? static_cast<SensorInput&>(topics->input) : live;
  const Observed observed = observe(live, watched, lidars, page.get(), writer.get());
  if (topics) fmt::print("  scans not published {}\n", topics->topics.dropped());
  if (writer) writer->close();
  if (page) fmt::print("  {} pages, the first gets {:.2f} Mbit/s\n", arguments.pages, 1e-6 * page->readers.stop());
  lidars.wait();
  for (const std::string& warning : live.takeWarnings()) fmt::print("  warning: {}\n", warning);
  return report(arguments, lidars, live, observed) ? 0 : 1;
}
}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("Live input measured over the loopback interface");
  Arguments arguments;
  app.add_option("--sensors", arguments.loopback.sensors, "lidars")->check(CLI::Range(1, 64));
  app.add_option("--seconds", arguments.loopback.seconds, "of the host")->check(CLI::PositiveNumber);
  app.add_option("--speed", arguments.loopback.speed, "seconds of the lidars per second of the host")
      ->check(CLI::PositiveNumber);
  app.add_option("--scan-rate", arguments.scan_rate, "Hz")->check(CLI::PositiveNumber);
  app.add_option("--deadline-ms", arguments.deadline_ms, "ms")->check(CLI::NonNegativeNumber);
  app.add_option("--busy", arguments.busy, "processes that keep the processor busy meanwhile")
      ->check(CLI::Range(0, 256));
  app.add_option("--rawlog", arguments.rawlog, "write scans and IMU samples to this file");
  app.add_option("--compression-level", arguments.compression_level, "of the rawlog")->check(CLI::Range(0, 9));
  app.add_flag("--web", arguments.web, "show the run on a page");
  app.add_flag("--ros2", arguments.ros2, "publish the scans on topics of ROS 2");
  app.add_option("--pages", arguments.pages, "readers of the page")->check(CLI::Range(0, 8));
  app.add_option("--spoofed", arguments.loopback.spoofed, "copies of the first lidar's packets per second")
      ->check(CLI::Range(0, 1000));
  app.add_option("--flood", arguments.loopback.flood, "IMU packets with wrong stamps per second")
      ->check(CLI::Range(0, 100000));
  CLI11_PARSE(app, argc, argv);
  return run(arguments);
}
