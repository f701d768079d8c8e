/** `scanloom site`: one map of several drives, in the frame of a reference. */
#include "Arguments.h"
#include "Reference.h"
#include "Settings.h"
#include "base/core/ConfigError.h"
#include "base/core/Interruption.h"
#include "base/core/OutputFolder.h"
#include "base/core/Progress.h"
#include "base/positions/ClockOffset.h"
#include "base/positions/TotalStation.h"
#include "estimation/slam/PlaceSearch.h"
#include "site/GnssOfRawlog.h"
#include "site/SiteFiles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <memory>

namespace scanloom
{
namespace
{
struct SiteArguments
{
  ConfigurationArguments configuration;
  OutputFolderArguments output;
  std::vector<std::filesystem::path> drives, references;
  std::string lever_arm, crs;
};

/** Of the first drive's run, unless others are given: it says what kind of world the drives are in. */
SlamSettings settingsFor(const SiteArguments& arguments)
{
  ConfigurationArguments configuration = arguments.configuration;
  const std::filesystem::path of_run = arguments.drives.front() / "configuration.ini";
  if (configuration.files.empty() && std::filesystem::exists(of_run)) configuration.files = {of_run};
  return load<SlamSettings>(configuration).settings;
}

/** What is gone is what a later drive does not see. Clocks that begin with the sensor tell no day. */
void requireOldestFirst(const SiteDrive& before, const SiteDrive& after)
{
  constexpr Timestamp kOfASensor{1'000'000'000s};  // 2001
  if (before.keyframes().empty() || after.keyframes().empty()) return;
  const Timestamp first = before.keyframes().front().stamp, second = after.keyframes().front().stamp;
  if (second < first && second > kOfASensor)
    throw UsageError(fmt::format("{} was driven before {}: give the oldest drive first", after.folder().string(),
                                 before.folder().string()));
}

std::vector<SiteDrive> readDrives(const std::vector<std::filesystem::path>& folders)
{
  std::vector<SiteDrive> drives;
  for (std::size_t i = 0; i < folders.size(); ++i)
  {
    for (std::size_t k = 0; k < i; ++k)
      if (std::filesystem::equivalent(folders[i], folders[k]))
        throw UsageError(fmt::format("{} is given twice", folders[i].string()));
    drives.emplace_back(folders[i]);
    if (i > 0) requireOldestFirst(drives[i - 1], drives[i]);
  }
  return drives;
}

struct References
{
  std::vector<Reference> all;
  SiteFrame frame;
};

/** Files of GNSS share an origin. Throws UsageError where they do not share a frame. */
References readReferences(const SiteArguments& arguments)
{
  if (arguments.references.empty())
  {
    if (arguments.crs.empty()) return {};
    throw UsageError("--crs: without --reference nothing says where in these coordinates the site is");
  }
  if (arguments.lever_arm.empty())
    throw UsageError("--reference: say where prism or antenna is on the body, --lever-arm \"x y z\" in m");
  const Eigen::Vector3d lever_arm = leverArmOf(arguments.lever_arm);
  References references;
  if (!arguments.crs.empty()) references.frame.grid.emplace(arguments.crs);
  bool local = false;
  for (const std::filesystem::path& path : arguments.references)
  {
    PositionFile file = path.extension() == ".rawlog" ? readGnssOfRawlog(path, references.frame.origin)
                                                      : readPositionFile(path, references.frame.origin);
    const ReferenceNoise noise = file.origin ? kGnssNoise : kTotalStationNoise;
    references.all.push_back({std::move(file.track), lever_arm, noise});
    const auto& grid = references.frame.grid;
    if (grid && !file.origin && !references.all.back().track.empty() &&
        !grid->reaches(references.all.back().track.front().position))
      throw UsageError(
          fmt::format("--crs {}: x and y of {} are not in it: its area is elsewhere", arguments.crs, path.string()));
    if (file.origin) references.frame.origin = file.origin;
    local |= !file.origin;
  }
  if (local && references.frame.origin)
    throw UsageError(
        "--reference: latitude and longitude, and x and y of a station, are in different frames: give one");
  return references;
}

/** "monday, tuesday from 35 s on" */
std::string drivesIn(std::size_t piece, const Site& site, const std::vector<SiteDrive>& drives)
{
  const std::vector<std::string> names = namesOf(drives);
  std::vector<std::string> texts;
  for (std::size_t d = 0; d < drives.size(); ++d)
  {
    const std::vector<DrivePiece> parts = piecesOf(d, site, drives);
    for (const DrivePiece& part : parts)
      if (part.piece == piece)
        texts.push_back(parts.size() == 1 ? names[d]
                                          : fmt::format("{} from {:.0f} s to {:.0f} s", names[d],
                                                        seconds(part.begin - parts.front().begin),
                                                        seconds(part.end - parts.front().begin)));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

void reportLoops(const Site& site)
{
  std::map<LoopDecision, int> counts;
  for (const Loop& loop : site.loops) ++counts[loop.decision];
  std::vector<std::string> refused;
  for (const auto& [decision, count] : counts)
    if (decision != LoopDecision::Accepted) refused.push_back(fmt::format("{} {}", count, toString(decision)));
  fmt::print("{} keyframes, {} loops{}\n", site.keyframes.size(), counts[LoopDecision::Accepted],
             refused.empty() ? "" : fmt::format(" (refused: {})", fmt::join(refused, ", ")));
}

/** @return whether all drives are in one piece. */
bool reportPieces(const Site& site, const std::vector<SiteDrive>& drives)
{
  if (site.pieces.size() == 1) return true;
  fmt::print("{} pieces that have no place in common:\n", site.pieces.size());
  for (std::size_t p = 0; p < site.pieces.size(); ++p)
    fmt::print("  {}: {} keyframes: {}{}\n", p + 1, site.pieces[p].keyframes.size(), drivesIn(p + 1, site, drives),
               site.pieces[p].is_in_reference_frame ? " (in the reference's frame)" : "");
  return false;
}

/** A clock that is off moves what is measured along the way, where loops hardly show it. @return whether it is right.
 */
bool reportClock(const std::filesystem::path& file, const Reference& reference, const Trajectory& trajectory,
                 const std::string& drive)
{
  const double usual = reference.noise.lasting > Duration{0} ? 1 : 0.05;  // s: GNSS of 2 m tells no less
  const auto late = clockOffset(trajectory, reference.body_p_point, reference.track);
  if (!late || std::abs(seconds(*late)) < usual) return true;
  warn(fmt::format("{}: its clock is {:.2f} s {} that of {}: positions are wrong along the way", file.string(),
                   std::abs(seconds(*late)), seconds(*late) > 0 ? "behind" : "ahead of", drive));
  return false;
}

/** @return whether the references are used, and agree with the drives. */
bool reportReferences(const Site& site, const std::vector<SiteDrive>& drives, const std::vector<Reference>& references,
                      const std::vector<std::filesystem::path>& files)
{
  if (references.empty()) return true;
  if (site.references.empty())
  {
    warn("no reference has a time in common with a drive");
    return false;
  }
  double squares = 0;
  std::size_t used = 0;
  for (const ReferencePosition& at : site.references)
    if (at.used) ++used, squares += at.residual.squaredNorm();
  if (used == 0)
  {
    warn(fmt::format("the references are not used: {} positions do not tell where a piece is", site.references.size()));
    return false;
  }
  fmt::print("references: {} of {} positions agree, {:.3f} m off in the mean\n", used, site.references.size(),
             std::sqrt(squares / static_cast<double>(used)));
  constexpr double kMostOutliers = 0.2;
  bool good = static_cast<double>(used) > (1 - kMostOutliers) * static_cast<double>(site.references.size());
  if (!good) warn("positions of the references contradict the drives or each other: see references.csv");
  const std::vector<std::string> names = namesOf(drives);
  for (std::size_t r = 0; r < references.size(); ++r)
    for (std::size_t d = 0; d < drives.size(); ++d)
      good &= reportClock(files[r], references[r], trajectoryIn(site, drives, d), names[d]);
  for (const SitePiece& piece : site.pieces)
    if (!piece.is_in_reference_frame) good = false;
  return good;
}

struct Interrupted
{
};

/** Throws Interrupted. */
SiteProgress showing(Progress& progress)
{
  return [&progress](double share)
  {
    if (interrupted()) throw Interrupted{};
    progress.update(static_cast<std::uint64_t>(100 * share));
  };
}

SiteMap writeShowingProgress(const std::filesystem::path& folder, const Site& site,
                             const std::vector<SiteDrive>& drives, const SiteFrame& frame)
{
  Progress progress("tiles", 100, "%");
  return writeSite(folder, site, drives, frame, showing(progress));
}

/** Throws Interrupted. */
Site madeShowingProgress(const std::vector<SiteDrive>& drives, const SlamSettings& settings,
                         const std::vector<Reference>& references)
{
  Progress progress("loops", 100, "%");
  return madeOf(drives, settings, references, showing(progress));
}

int run(const SiteArguments& arguments)
try
{
  catchInterruption();
  refuseExisting(arguments.output, siteFiles());
  const SlamSettings settings = settingsFor(arguments);
  const References references = readReferences(arguments);
  const std::vector<SiteDrive> drives = readDrives(arguments.drives);
  OutputFolder folder(arguments.output.folder);
  const Site site = madeShowingProgress(drives, settings, references.all);
  const SiteMap map = writeShowingProgress(folder.running(), site, drives, references.frame);
  const std::filesystem::path kept = folder.commit(siteFiles(), Completeness::Whole);

  reportLoops(site);
  const bool whole = reportPieces(site, drives);
  fmt::print("{} tiles; {} things that earlier drives saw are gone: gone.csv\n", map.tiles, map.gone.size());
  const bool referenced = reportReferences(site, drives, references.all, arguments.references);
  if (const auto& origin = references.frame.origin; origin && site.pieces.front().is_in_reference_frame)
    fmt::print("east, north and up of latitude {:.7f}, longitude {:.7f}, height {:.2f} m\n", origin->latitude,
               origin->longitude, origin->height);
  fmt::print("{}\n", (kept / "keyframes.simplemap").string());
  return whole && referenced ? kDone : kQualityGate;
}
catch (const Interrupted&)
{
  return kInterrupted;
}

std::function<int()> addSiteOptions(CLI::App& app)
{
  auto arguments = std::make_shared<SiteArguments>();
  addOption(app, "DRIVE", arguments->drives, "result folders of slam, the oldest first").required().existingFolder();
  addConfiguration(app, arguments->configuration);
  addOutputFolder(app, arguments->output).required();
  addOption(
      app, "--reference", arguments->references,
      "positions of a prism by a total station, or of an antenna by GNSS (lat, lon, height; or CObservationGPS in a "
      ".rawlog); repeatable: the site gets their frame")
      .repeatable()
      .existingFile()
      .typeName("FILE");
  addOption(app, "--lever-arm", arguments->lever_arm,
            "with --reference: where prism or antenna is on the body, \"x y z\" in m")
      .typeName("XYZ");
  addOption(app, "--crs", arguments->crs,
            "with --reference: write the points as LAS tiles in these coordinates of a country, such as EPSG:3067; x "
            "and y of a station are taken to be in them")
      .typeName("CRS");
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb siteVerb()
{
  return {"site", "one map of several drives: loops closed, in the frame of a reference", schemaOf<SlamSettings>(),
          &addSiteOptions};
}
}  // namespace scanloom
