/**
 * Two lidars on a machine at rest amid a ring of panels that all move away from it at 10 km/h, as raw packets; and what
 * becomes of the panels in the scans of a batcher. For the paper's section 1.1: what it costs to put turns together.
 */
#pragma once
#include "input/batching/TimeBatcher.h"
#include "input/lidar/OusterDecoder.h"
#include "input/lidar/OusterEncoder.h"
#include "lab/whole_turns/WholeTurns.h"
#include "support/ScanMeasures.h"
#include "support/pushPacket.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace scanloom::panels
{
constexpr Duration kTurn = 100ms;
constexpr int kColumns = 1024, kColumnsPerPacket = 16, kChannels = 16, kTurns = 14;
constexpr Duration kNetworkDelay = 100us;
constexpr Timestamp kBegin{Duration{std::chrono::hours{24 * 365 * 55}}};

constexpr double kSpeed = 10 / 3.6, kDistance = 20, kWidth = 1.6;
constexpr int kPanels = 36;
constexpr double kDoubled = 0.9 * kSpeed * 0.1;  // m, of smear: seen nearly a whole turn apart
constexpr std::size_t kFewestPoints = 20;        // per lidar: less is a rim cut by the end of a scan

inline double azimuthOf(int panel) { return 2 * M_PI * panel / kPanels; }
inline Eigen::Vector3d directionOf(int panel) { return {std::cos(azimuthOf(panel)), std::sin(azimuthOf(panel)), 0}; }

/** How the second lidar is turned and when it passes its encoder's zero after the first. */
struct Mounting
{
  Duration phase{0};
  double yaw = 0;
};

/** Both beams sweep the same direction of the body at every moment: phase-locked, but mounted at different yaw. */
inline Mounting inStep(Duration phase) { return {phase, -2 * M_PI * seconds(phase) / seconds(kTurn)}; }

/** Turned alike: the second beam follows the first. */
inline Mounting alike(Duration phase) { return {phase, 0}; }

inline OusterMetadata sensor()
{
  OusterMetadata m;
  m.lidar_mode = "1024x10";
  m.lidar_profile = "RNG19_RFL8_SIG16_NIR16";
  m.channels = kChannels;
  m.columns_per_packet = kColumnsPerPacket;
  m.columns_per_frame = kColumns;
  m.last_column = kColumns - 1;
  m.frame_rate = 1 / seconds(kTurn);
  for (int i = 0; i < kChannels; ++i) m.beam_altitude_deg.push_back(7.5 - i);
  m.beam_azimuth_deg.assign(kChannels, 0);
  return m;
}

inline std::array<Rigid, 2> posesOf(const Mounting& mounting)
{
  return {Rigid::fromXyzYawPitchRoll(0, 0.5, 0, 0, 0, 0), Rigid::fromXyzYawPitchRoll(0, -0.5, 0, mounting.yaw, 0, 0)};
}

inline std::vector<BatchedLidar> lidarsOf(const Mounting& mounting)
{
  std::vector<BatchedLidar> lidars;
  for (const Rigid& body_T_sensor : posesOf(mounting))
    lidars.push_back({std::to_string(lidars.size()), std::make_shared<OusterDecoder>(sensor(), body_T_sensor)});
  return lidars;
}

/** To the panel that this ray hits; 0 for none. */
inline double rangeAlong(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, Timestamp t)
{
  const double distance = kDistance + kSpeed * seconds(t - kBegin);
  const long nearest = std::lround(std::atan2(direction.y(), direction.x()) * kPanels / (2 * M_PI));
  for (long panel = nearest - 1; panel <= nearest + 1; ++panel)
  {
    const Eigen::Vector3d normal = directionOf(static_cast<int>(panel));
    const double range = (distance - normal.dot(origin)) / normal.dot(direction);
    const Eigen::Vector3d hit = origin + range * direction;
    if (std::abs(normal.x() * hit.y() - normal.y() * hit.x()) < kWidth / 2) return range;
  }
  return 0;
}

/** A column by the maker's formula: columns turn clockwise from the x axis. */
inline OusterColumn columnAt(const OusterMetadata& m, const Rigid& body_T_sensor, Timestamp stamp, int turn, int id)
{
  OusterColumn column{stamp, static_cast<std::uint32_t>(turn), static_cast<std::uint16_t>(id), true, {}};
  const double th = -2 * M_PI * id / kColumns;
  for (const double altitude_deg : m.beam_altitude_deg)
  {
    const double al = altitude_deg * M_PI / 180;
    const Eigen::Vector3d ray(std::cos(th) * std::cos(al), std::sin(th) * std::cos(al), std::sin(al));
    const double range = rangeAlong(body_T_sensor.translation, body_T_sensor.rotation * ray, stamp);
    OusterReading reading;
    reading.first = {static_cast<std::uint32_t>(std::lround(1e3 * range)), 100, 100};
    column.readings.push_back(reading);
  }
  return column;
}

struct Arrival
{
  LidarIndex lidar = 0;
  std::vector<std::uint8_t> packet;
  Timestamp received;
};

/** All packets of the drive as they arrive: each a fixed delay after its last stamp. */
inline std::vector<Arrival> arrivalsOf(const Mounting& mounting)
{
  const OusterMetadata m = sensor();
  const OusterEncoder encoder(m);
  const std::array<Rigid, 2> poses = posesOf(mounting);
  std::vector<Arrival> arrivals;
  for (LidarIndex lidar = 0; lidar < poses.size(); ++lidar)
    for (int first = 0; first < kTurns * kColumns; first += kColumnsPerPacket)
    {
      std::vector<OusterColumn> columns;
      for (int i = first; i < first + kColumnsPerPacket; ++i)
        columns.push_back(columnAt(m, poses[lidar], kBegin + (lidar == 1 ? mounting.phase : 0ms) + i * kTurn / kColumns,
                                   i / kColumns, i % kColumns));
      arrivals.push_back({lidar, encoder.lidarPacket(columns), columns.back().stamp + kNetworkDelay});
    }
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const Arrival& a, const Arrival& b) { return a.received < b.received; });
  return arrivals;
}

/** Over all scans but the first two and those of the last turn, after which nothing comes. */
struct Figures
{
  Duration longest_span{0};
  Duration longest_held{0};    // from the last packet of the lidar that is ready first to that of the last one
  std::vector<double> smears;  // m, ascending: of every panel in every scan where both lidars see it

  double smear(double quantile) const
  {
    return smears[static_cast<std::size_t>(quantile * static_cast<double>(smears.size() - 1))];
  }
  /** Of all, how much is above `limit`. */
  double shareAbove(double limit) const
  {
    const auto above = smears.end() - std::upper_bound(smears.begin(), smears.end(), limit);
    return static_cast<double>(above) / static_cast<double>(smears.size());
  }
  double meanSmear() const
  {
    double sum = 0;
    for (const double s : smears) sum += s;
    return sum / static_cast<double>(smears.size());
  }
};

inline void addSmears(const Scan& scan, std::vector<double>& smears)
{
  std::array<std::vector<std::size_t>, kPanels> points;
  std::array<std::array<std::size_t, 2>, kPanels> seen_by{};
  for (std::size_t i = 0; i < scan.points.size(); ++i)
  {
    const double azimuth = std::atan2(scan.points.y[i], scan.points.x[i]);
    const auto panel = static_cast<std::size_t>((std::lround(azimuth * kPanels / (2 * M_PI)) + kPanels) % kPanels);
    points[panel].push_back(i);
    ++seen_by[panel][scan.points.sensor_id[i]];
  }
  for (std::size_t panel = 0; panel < kPanels; ++panel)
    if (std::min(seen_by[panel][0], seen_by[panel][1]) >= kFewestPoints)
      smears.push_back(extentAlong(directionOf(static_cast<int>(panel)), scan.points, points[panel]));
}

/** From the last packet of the lidar that is ready first to that of the other. */
inline Duration heldIn(const Scan& scan)
{
  std::array<Timestamp, 2> ready{};
  for (const Column& c : scan.columns)
  {
    const int columns_to_come = kColumnsPerPacket - 1 - c.measurement_id % kColumnsPerPacket;
    ready[c.sensor_id] = std::max(ready[c.sensor_id], c.stamp + columns_to_come * kTurn / kColumns);
  }
  return std::chrono::abs(ready[0] - ready[1]);
}

inline std::vector<Scan> scansByTime(const Mounting& mounting)
{
  TimeBatcher batcher(lidarsOf(mounting), {});
  std::vector<Scan> scans;
  for (const Arrival& arrival : arrivalsOf(mounting))
    for (Scan& scan : push(batcher, arrival.lidar, arrival.packet, arrival.received)) scans.push_back(std::move(scan));
  return scans;
}

inline std::vector<Scan> scansOfTurns(TurnGrouping grouping, const Mounting& mounting)
{
  WholeTurns turns(2, grouping);
  std::vector<Scan> scans;
  for (const Scan& by_time : scansByTime(mounting))
    for (Scan& scan : turns.push(by_time)) scans.push_back(std::move(scan));
  return scans;
}

inline Figures figuresOf(const std::vector<Scan>& scans)
{
  Figures figures;
  for (std::size_t i = 2; i < scans.size(); ++i)
  {
    if (scans[i].end() > kBegin + (kTurns - 1) * kTurn) continue;
    figures.longest_span = std::max(figures.longest_span, spanOf(scans[i]));
    figures.longest_held = std::max(figures.longest_held, heldIn(scans[i]));
    addSmears(scans[i], figures.smears);
  }
  std::sort(figures.smears.begin(), figures.smears.end());
  return figures;
}
}  // namespace scanloom::panels
