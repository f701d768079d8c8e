/**
 * Localises short simulated drives and compares what is estimated and its covariance with the truth. NEES = e' C^-1 e;
 * its mean is the number of degrees of freedom where the covariances are right.
 */
#include "base/config/Configuration.h"
#include "base/core/Statistics.h"
#include "benchmarks/NeesHistogram.h"
#include "estimation/slam/LidarInertialSlam.h"
#include "support/SceneInput.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <deque>
#include <map>
#include <memory>

namespace scanloom
{
namespace
{
struct Arguments
{
  std::string stand = "sparse";
  int runs = 50;
  int first_seed = 1;
  double duration = 15;
  int beams = 32, columns = 512;
  std::vector<std::string> lidars;
  std::vector<std::string> assignments;
  std::vector<std::string> arms{"slam.every_nth=1", "slam.every_nth=15"};
  bool histograms = false;
};

struct Settings
{
  SimulationSettings simulation;
  std::vector<SlamSettings> arms;
  BatcherOptions batcher;
};

Settings settingsOf(const Arguments& a)
{
  const std::string params = std::string(SCANLOOM_SOURCE_DIR) + "/params/";
  setenv("SCANLOOM_RECORDING", "none", 0);  // which the file names; the drive is simulated
  Configuration all =
      Configuration::fromFiles({params + "dual_os0_recording.ini", params + "simulation/" + a.stand + ".ini"});
  all.set("simulated_drive.route=winding");
  all.set(fmt::format("simulated_drive.duration={}", a.duration));
  all.set(fmt::format("simulated_lidars.lidar1_model=OS0-{}", a.beams));
  all.set(fmt::format("simulated_lidars.lidar1_mode={}x10", a.columns));
  for (const std::string& assignment : a.assignments) all.set(assignment);
  Schema known = schemaOf<SimulationSettings>();
  for (const SectionDescription& section : schemaOf<SlamSettings>()) known.push_back(section);
  Settings settings{readSettings<SimulationSettings>(all, known), {}, all.read<BatcherOptions>("lidars")};
  for (const std::string& arm : a.arms)
  {
    Configuration of_arm = all;
    for (const std::string& assignment : CLI::detail::split(arm, ',')) of_arm.set(assignment);
    settings.arms.push_back(readSettings<SlamSettings>(of_arm, known));
  }
  return settings;
}

/** One estimate beside the truth. */
struct Sample
{
  double nees;
  double error;             // m, m/s or deg
  Eigen::VectorXd by_axis;  // squared error by variance
};

enum What
{
  kSinceStart,    // the pose given out, frames agreed at the first one
  kFromKeyframe,  // the pose in the local map, near what the scan is aligned to
  kRegistration,  // from the last keyframe, with the lidar's own covariance
  kVelocity,
  kTilt
};
using Samples = std::map<What, std::vector<Sample>>;

struct Named
{
  const char* name;
  const char* unit;
  int freedom;
};

Named named(What what)
{
  switch (what)
  {
    case kSinceStart:
      return {"pose since the start, as given out", "m", 6};
    case kFromKeyframe:
      return {"pose seen from the last keyframe", "m", 6};
    case kRegistration:
      return {"registration seen from the last keyframe", "m", 6};
    case kVelocity:
      return {"velocity", "m/s", 3};
    case kTilt:
      return {"roll and pitch against gravity", "deg", 2};
  }
  return {};
}

Sample sampleOf(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance, double size)
{
  return {error.dot(covariance.ldlt().solve(error)), size, error.cwiseAbs2().cwiseQuotient(covariance.diagonal())};
}

Sample poseSample(const Rigid& truth, const Rigid& estimate, const Matrix6d& covariance)
{
  const Vector6d error = boxMinus(truth, estimate);
  return sampleOf(error, covariance, error.head<3>().norm());
}

/** The drive in the map frame: origin and yaw are the body's at the start of the first scan. */
class Truth
{
 public:
  /** The scene must outlive it. */
  Truth(const Scene& scene, const Rigid& body_T_imu, Timestamp first_scan_start)
    : scene_(&scene), body_T_imu_(body_T_imu)
  {
    const Rigid start = motionAt(first_scan_start).world_T_body;
    const Rigid level = Rigid::fromXyzYawPitchRoll(start.translation.x(), start.translation.y(), start.translation.z(),
                                                   start.yawPitchRoll()[0], 0, 0);
    map_T_world_ = level.inverse();
  }

  Rigid bodyAt(Timestamp stamp) const { return map_T_world_ * motionAt(stamp).world_T_body; }

  NavState imuAt(Timestamp stamp) const
  {
    const Motion m = motionAt(stamp);
    NavState state;
    state.stamp = stamp;
    state.map_T_imu = map_T_world_ * m.world_T_body * body_T_imu_;
    const Eigen::Vector3d by_turning = m.angular_rate.cross(body_T_imu_.translation);
    state.velocity = map_T_world_.rotation * (m.velocity + m.world_T_body.rotation * by_turning);
    return state;
  }

 private:
  Motion motionAt(Timestamp stamp) const { return scene_->scenery.drive().at(scene_->span.secondsAt(stamp)); }

  const Scene* scene_;
  Rigid body_T_imu_, map_T_world_;
};

/** Estimates of one drive as they come. */
class Comparison
{
 public:
  Comparison(std::shared_ptr<const Scene> scene, const Rigid& body_T_imu)
    : scene_(std::move(scene)), body_T_imu_(body_T_imu)
  {
  }

  void add(const StateEstimate& e, const FixedLagSmoother& smoother)
  {
    if (!first_)
      begin(e);
    else
    {
      addPoses(e, smoother);
      addState(smoother);
    }
    if (e.keyframe) keyframe_ = {e.stamp, smoother.anchorBody().inverse() * e.keyframe->map_T_body};
    lost_ = lost_ || e.health == Health::Lost || e.recovered;
  }

  const Samples& samples() const { return samples_; }
  bool lost() const { return lost_; }

 private:
  void begin(const StateEstimate& e)
  {
    constexpr Duration kScan = 100ms;
    truth_.emplace(*scene_, body_T_imu_, e.stamp - kScan);
    first_ = {e.stamp, e.map_T_body};
  }

  Rigid trulyFrom(Timestamp reference, Timestamp now) const
  {
    return truth_->bodyAt(reference).inverse() * truth_->bodyAt(now);
  }

  void addPoses(const StateEstimate& e, const FixedLagSmoother& smoother)
  {
    const Rigid anchor_T_body = smoother.anchorBody().inverse() * e.map_T_body;
    samples_[kSinceStart].push_back(
        poseSample(trulyFrom(first_->stamp, e.stamp), first_->map_T_body.inverse() * e.map_T_body, e.since_start));
    const Rigid truth = trulyFrom(keyframe_.stamp, e.stamp);
    const Rigid keyframe_T_anchor = keyframe_.map_T_body.inverse();
    samples_[kFromKeyframe].push_back(poseSample(truth, keyframe_T_anchor * anchor_T_body, e.covariance));
    if (!e.trusted) return;
    const RegistrationResult& r = *e.registration;
    const Rigid anchor_T_registered = first_->map_T_body.inverse() * r.target_T_source;  // the local map began there
    samples_[kRegistration].push_back(poseSample(truth, keyframe_T_anchor * anchor_T_registered, r.covariance));
  }

  void addState(const FixedLagSmoother& smoother)
  {
    const NavState& state = smoother.newest();
    const Vector15d error = boxMinus(truth_->imuAt(state.stamp), state);
    const Matrix15d covariance = smoother.newestCovariance();
    const Eigen::Vector3d velocity = error.segment<3>(6);
    samples_[kVelocity].push_back(sampleOf(velocity, covariance.block<3, 3>(6, 6), velocity.norm()));
    // Turns about the map's x and y.
    const Eigen::Matrix3d map_R_imu = state.map_T_imu.rotation.toRotationMatrix();
    const Eigen::Vector2d tilt = (map_R_imu * error.segment<3>(3)).head<2>();
    const Eigen::Matrix3d turns = map_R_imu * covariance.block<3, 3>(3, 3) * map_R_imu.transpose();
    samples_[kTilt].push_back(sampleOf(tilt, turns.topLeftCorner<2, 2>(), tilt.norm() * 180 / M_PI));
  }

  std::shared_ptr<const Scene> scene_;
  Rigid body_T_imu_;
  std::optional<Truth> truth_;
  std::optional<StampedPose> first_;
  StampedPose keyframe_;  // the last one, seen from the anchor
  Samples samples_;
  bool lost_ = false;
};

/** A drive localised in all arms at once: to simulate it takes longer. */
std::vector<Comparison> drive(const Settings& settings, const std::vector<std::string>& lidars, std::uint64_t seed)
{
  const auto scene = std::make_shared<const Scene>(makeScene(settings.simulation, seed));
  const Rig rig = rigOf(*scene, settings.batcher, lidars);
  std::vector<MountedLidar> lidars_of_rig;
  for (const RigSensor& sensor : rig.sensors) lidars_of_rig.push_back({sensor.options.name, sensor.body_T_sensor});
  std::deque<LidarInertialSlam> slams;
  for (const SlamSettings& arm : settings.arms) slams.emplace_back(arm, *rig.body_T_imu, lidars_of_rig);
  std::vector<Comparison> comparisons(slams.size(), Comparison(scene, *rig.body_T_imu));
  const auto input = makeSceneInput(scene, rig);
  while (std::optional<SensorEvent> event = input->next({}))
    for (std::size_t arm = 0; arm < slams.size(); ++arm)
    {
      if (const auto* sample = std::get_if<SensorImu>(&*event); sample && sample->sensor == SensorImu::kBody)
        slams[arm].addImu(sample->sample);
      if (const auto* scan = std::get_if<Scan>(&*event))
        for (const StateEstimate& e : slams[arm].addScan(*scan)) comparisons[arm].add(e, *slams[arm].smoother());
    }
  return comparisons;
}

double meanOf(const std::vector<double>& values)
{
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

/** Of the mean, by the scatter of the runs: scans of one run err alike. */
double standardError(const std::vector<double>& of_runs)
{
  const double mean = meanOf(of_runs);
  std::vector<double> squares;
  for (const double v : of_runs) squares.push_back((v - mean) * (v - mean));
  return std::sqrt(meanOf(squares) / std::max<double>(1, static_cast<double>(of_runs.size()) - 1));
}

struct Column
{
  std::vector<double> nees, errors, of_runs, at_end;
  Eigen::VectorXd by_axis;
};

Column columnOf(What what, const std::vector<Samples>& runs)
{
  Column all;
  for (const Samples& run : runs)
  {
    const auto found = run.find(what);
    if (found == run.end()) continue;
    std::vector<double> here;
    for (const Sample& sample : found->second)
    {
      here.push_back(sample.nees);
      all.errors.push_back(sample.error);
      all.by_axis = all.by_axis.size() == 0 ? sample.by_axis : Eigen::VectorXd(all.by_axis + sample.by_axis);
    }
    all.nees.insert(all.nees.end(), here.begin(), here.end());
    all.of_runs.push_back(meanOf(here));
    all.at_end.push_back(here.back());
  }
  all.by_axis /= static_cast<double>(all.nees.size());
  std::sort(all.errors.begin(), all.errors.end());
  return all;
}

void print(const std::vector<Samples>& runs, bool histograms)
{
  fmt::print(
      "| | degrees of freedom | mean NEES | at the end | median error | largest | squared error by variance, axis by "
      "axis |\n"
      "|---|--:|--:|--:|--:|--:|---|\n");
  for (const What what : {kSinceStart, kFromKeyframe, kRegistration, kVelocity, kTilt})
  {
    const Column c = columnOf(what, runs);
    const auto [name, unit, freedom] = named(what);
    std::string axes;
    for (const double v : c.by_axis) axes += fmt::format("{:.2f} ", v);
    fmt::print("| {} | {} | {:.2f} ± {:.2f} | {:.2f} | {:.4f} {} | {:.4f} {} | {}|\n", name, freedom, meanOf(c.of_runs),
               standardError(c.of_runs), meanOf(c.at_end), quantileOfSorted(c.errors, 0.5), unit, c.errors.back(), unit,
               axes);
  }
  if (!histograms) return;
  for (const What what : {kSinceStart, kFromKeyframe, kVelocity, kTilt})
  {
    fmt::print("\n{}:\n", named(what).name);
    printHistogram(columnOf(what, runs).nees, named(what).freedom);
  }
}

void printProgress(std::uint64_t seed, const std::string& arm, const Comparison& run)
{
  std::string means;
  for (const auto& [what, samples] : run.samples())
  {
    std::vector<double> nees;
    for (const Sample& sample : samples) nees.push_back(sample.nees);
    means += fmt::format(" {:.3f}", meanOf(nees));
  }
  fmt::print(stderr, "seed {} {} {}{}\n", seed, arm, run.lost() ? "LOST" : "followed", means);
}

void run(const Arguments& arguments)
{
  const Settings settings = settingsOf(arguments);
  std::vector<std::vector<Samples>> runs(
      settings.arms.size());  // LOST ones are left out: health says so, no covariance
  for (int i = 0; i < arguments.runs; ++i)
  {
    const auto seed = static_cast<std::uint64_t>(arguments.first_seed + i);
    const std::vector<Comparison> comparisons = drive(settings, arguments.lidars, seed);
    for (std::size_t arm = 0; arm < runs.size(); ++arm)
    {
      printProgress(seed, arguments.arms[arm], comparisons[arm]);
      if (!comparisons[arm].lost()) runs[arm].push_back(comparisons[arm].samples());
    }
  }
  for (std::size_t arm = 0; arm < runs.size(); ++arm)
  {
    fmt::print("\n{}: {} drives of {} s, {}; {} LOST, which are left out\n\n", arguments.stand, arguments.runs,
               arguments.duration, arguments.arms[arm], static_cast<std::size_t>(arguments.runs) - runs[arm].size());
    if (!runs[arm].empty()) print(runs[arm], arguments.histograms);
  }
}
}  // namespace
}  // namespace scanloom

int main(int argc, char** argv)
{
  scanloom::Arguments a;
  CLI::App app{"Errors of localisation beside its covariances, over short simulated drives"};
  app.add_option("--stand", a.stand, "a file of params/simulation without its ending")->capture_default_str();
  app.add_option("--runs", a.runs, "each in a stand of its own")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--first-seed", a.first_seed)->capture_default_str();
  app.add_option("--duration", a.duration, "s, at rest at both ends")->capture_default_str();
  app.add_option("--arm", a.arms, "slam's section.key=value,..., compared on the same drives (repeatable)")
      ->capture_default_str();
  app.add_option("--beams", a.beams)->capture_default_str();
  app.add_option("--columns", a.columns)->capture_default_str();
  app.add_option("--lidars", a.lidars, "left, right; all where none is named")->delimiter(',');
  app.add_option("--set", a.assignments, "section.key=value on top (repeatable)");
  app.add_flag("--histograms", a.histograms);
  CLI11_PARSE(app, argc, argv);
  try
  {
    scanloom::run(a);
  }
  catch (const std::exception& e)
  {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  }
}
