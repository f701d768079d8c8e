#include "simulation/SimulatedLidar.h"

#include "simulation/AssumedOuster.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kMillimetre = 1e-3;
constexpr double kRadians = M_PI / 180;
constexpr double kPhotonsAtHalf = 25;  // of the returns: of the order that sensors report at the end of their range
constexpr double kSkyNearIr = 900, kNearIrOfWhite = 1200;  // photons of daylight under trees

Rigid fromMillimetres(Eigen::Matrix4d matrix)
{
  matrix.topRightCorner<3, 1>() *= kMillimetre;
  return Rigid::fromMatrix(matrix);
}

/** A unit without a product line is taken for an OS1, as the metadata's parser does. */
RangingOptions ofDataSheet(RangingOptions ranging, const std::string& product_line)
{
  const OusterFamily& family = ousterFamily(product_line.empty() ? "OS1" : product_line);
  if (ranging.range_at_ten_percent == 0) ranging.range_at_ten_percent = family.range_at_ten_percent;
  if (ranging.least_range == 0) ranging.least_range = family.least_range;
  return ranging;
}

std::uint16_t photons(double count) { return static_cast<std::uint16_t>(std::clamp(count, 1.0, 65535.0)); }
}  // namespace

double signalStrength(double reflectivity, double cosine_incidence, double range, double range_at_ten_percent)
{
  const double reach = range_at_ten_percent / range;
  return reflectivity / 0.10 * cosine_incidence * reach * reach;
}

double chanceOfReturn(double strength) { return std::clamp((1.3 - 1 / std::sqrt(strength)) / 0.6, 0.0, 1.0); }

double rangeNoise(const RangingOptions& ranging, double strength)
{
  return std::hypot(ranging.range_noise, ranging.range_noise_weak / std::sqrt(strength));
}

SimulatedLidar::SimulatedLidar(OusterMetadata metadata, const Rigid& body_T_sensor, const LidarTiming& timing,
                               const RangingOptions& ranging, std::uint64_t seed, std::uint64_t place)
  : metadata_(std::move(metadata)),
    body_T_sensor_(body_T_sensor),
    body_T_lidar_(body_T_sensor * fromMillimetres(metadata_.lidar_to_sensor_mm)),
    timing_(timing),
    ranging_(ofDataSheet(ranging, metadata_.product_line)),
    seed_(seed),
    place_(place),
    beam_radius_(kMillimetre * metadata_.beam_to_lidar_mm(0, 3)),
    beam_height_(kMillimetre * metadata_.beam_to_lidar_mm(2, 3))
{
  for (int beam = 0; beam < metadata_.channels; ++beam)
  {
    const double azimuth = -kRadians * metadata_.beam_azimuth_deg[beam];  // the file's azimuths are clockwise
    const double altitude = kRadians * metadata_.beam_altitude_deg[beam];
    beam_directions_.emplace_back(std::cos(azimuth) * std::cos(altitude), std::sin(azimuth) * std::cos(altitude),
                                  std::sin(altitude));
  }
}

bool SimulatedLidar::sends(std::uint16_t measurement_id) const
{
  const bool from_first = measurement_id >= metadata_.first_column, to_last = measurement_id <= metadata_.last_column;
  return metadata_.first_column <= metadata_.last_column ? from_first && to_last : from_first || to_last;
}

OusterColumn SimulatedLidar::measure(const Scenery& scenery, std::uint64_t column) const
{
  const ColumnInstant instant = instantOf(column);
  OusterColumn measured;
  measured.stamp = instant.stamp;
  measured.frame_id = instant.frame_id;
  measured.measurement_id = instant.measurement_id;
  measured.valid = sends(instant.measurement_id);
  if (!measured.valid) return measured;

  const Moment moment = scenery.at(seconds(instant.truth - timing_.start));
  const double turn = 2 * M_PI * (1 - static_cast<double>(measured.measurement_id) / metadata_.columns_per_frame);
  const Eigen::Quaterniond encoder(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
  const Rigid world_T_rotor = moment.worldTBody() * body_T_lidar_ * Rigid{encoder, Eigen::Vector3d::Zero()};
  const Eigen::Vector3d origin = world_T_rotor * Eigen::Vector3d(beam_radius_, 0, beam_height_);
  const Eigen::Matrix3d world_R_rotor = world_T_rotor.rotation.toRotationMatrix();

  // Every beam draws the same number of times, so that one lost return does not change its neighbours.
  Random random(seed_, RandomStream::Lidar, place_, column);
  std::vector<RayQuery> queries;
  std::vector<Luck> lucks;
  for (const Eigen::Vector3d& direction : beam_directions_)
  {
    queries.push_back({{origin, world_R_rotor * direction}, ranging_.farthest_range, random.bits()});
    lucks.push_back(drawLuck(random));
  }
  const std::vector<std::optional<Hit>> hits = moment.cast(queries);
  for (std::size_t beam = 0; beam < hits.size(); ++beam)
    measured.readings.push_back(readingOf(hits[beam], lucks[beam]));
  return measured;
}

SimulatedLidar::Luck SimulatedLidar::drawLuck(Random& random)
{
  Luck luck;
  luck.noise = random.normal();
  luck.detection = random.uniform();
  luck.shade = random.normal();
  return luck;
}

OusterReading SimulatedLidar::readingOf(const std::optional<Hit>& hit, const Luck& luck) const
{
  OusterReading measured;
  const double reflectivity = hit ? std::max(0.01, reflectivityOf(hit->surface) * (1 + 0.1 * luck.shade)) : 0;
  measured.near_ir = photons((hit ? kNearIrOfWhite * reflectivity : kSkyNearIr) * (1 + 0.1 * luck.shade));
  if (!hit || hit->range < ranging_.least_range) return measured;
  const double strength =
      signalStrength(reflectivity, hit->cosine_incidence, hit->range, ranging_.range_at_ten_percent);
  if (luck.detection >= chanceOfReturn(strength)) return measured;

  // The sensor's range is counted from the axis of rotation, along the path of the light: radius, then beam.
  const double origin_to_axis = std::hypot(beam_radius_, beam_height_);
  const double range = hit->range + rangeNoise(ranging_, strength) * luck.noise + origin_to_axis;
  measured.first.range_mm = static_cast<std::uint32_t>(std::lround(std::max(range, kMillimetre) / kMillimetre));
  measured.first.reflectivity = static_cast<std::uint8_t>(std::clamp(100 * reflectivity, 1.0, 100.0));
  measured.first.signal = photons(kPhotonsAtHalf * strength);
  return measured;
}

double SimulatedLidar::reflectivityOf(Surface surface) const
{
  switch (surface)
  {
    case Surface::Ground:
      return ranging_.ground;
    case Surface::Stem:
      return ranging_.stem;
    case Surface::Branch:
      return ranging_.branch;
    case Surface::Crown:
      return ranging_.crown;
    case Surface::Undergrowth:
      return ranging_.undergrowth;
    case Surface::Machine:
    case Surface::Boom:
      return ranging_.machine;
    case Surface::Object:
      return ranging_.object;
  }
  return 0;
}
}  // namespace scanloom
