#include "lab/study/ExperimentPlan.h"

#include "lab/study/ContentHash.h"
#include "lab/study/RunReference.h"
#include "lab/study/internal/AxisValues.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>

namespace scanloom
{
namespace
{
constexpr const char* kSection = "experiment";

/** Relative paths start at the folder of the file that names them; those of --set at the current folder. */
std::vector<std::filesystem::path> pathsOf(const std::string& key, const std::string& text,
                                           const Configuration& configuration, const std::string& no_path = "")
{
  std::vector<std::filesystem::path> paths;
  std::string missing;
  for (const std::string& word : wordsOf(text))
  {
    if (word == no_path)
    {
      paths.emplace_back(word);
      continue;
    }
    const Place place = configuration.place(kSection, key);
    const auto folder = place.line > 0 ? std::filesystem::path(place.file).parent_path() : std::filesystem::path();
    paths.push_back((folder / word).lexically_normal());
    if (!std::filesystem::exists(paths.back()))
      missing += fmt::format("{}'{}' does not exist", missing.empty() ? "" : ", ", paths.back().string());
  }
  if (!missing.empty()) throw configuration.invalidValue(kSection, key, missing);
  return paths;
}

/** Without a slash at its end. */
std::filesystem::path nameable(const std::filesystem::path& path)
{
  return path.has_filename() ? path : path.parent_path();
}

/** `sparse` for "recordings/sparse/", "stands/sparse.ini" and "sparse.pcap.gz". */
std::string standOf(const std::filesystem::path& path)
{
  const std::filesystem::path name = nameable(path);
  const bool packed = name.extension() == ".gz" || name.extension() == ".zst";
  return (packed ? name.stem() : name).stem().string();
}

PlannedRun onSimulation(const std::filesystem::path& file)
{
  PlannedRun run;
  run.stand = standOf(file);
  run.simulation = file;
  return run;
}

PlannedRun onRecording(const std::filesystem::path& recording)
{
  PlannedRun run;
  run.stand = standOf(recording);
  run.recording = recording;
  return run;
}

/** Runs of monday/drive.pcap and tuesday/drive.pcap would be taken for repetitions of one: `monday drive`. */
void tellApart(std::vector<PlannedRun>& runs)
{
  std::map<std::string, int> uses;
  for (const PlannedRun& run : runs) ++uses[run.stand];
  for (PlannedRun& run : runs)
    if (uses[run.stand] > 1 && !run.recording.empty())
      run.stand =
          nameable(std::filesystem::absolute(run.recording)).parent_path().filename().string() + ' ' + run.stand;
}

/** Each a drive: a run that is still to be combined with lidars, N and parameters. */
std::vector<PlannedRun> drivesIn(const ExperimentPlan& plan)
{
  std::vector<PlannedRun> runs;
  for (const auto& file : plan.simulations) runs.push_back(onSimulation(file));
  for (std::size_t i = 0; i < plan.recordings.size(); ++i)
  {
    runs.push_back(onRecording(plan.recordings[i]));
    if (!plan.references.empty()) runs.back().reference = plan.references[i];
  }
  tellApart(runs);
  return runs;
}

/** A plan without runs. */
ExperimentPlan filesNamedIn(const ExperimentOptions& options, const Configuration& configuration)
{
  ExperimentPlan plan;
  plan.simulations = pathsOf("simulations", options.simulations, configuration);
  plan.recordings = pathsOf("recordings", options.recordings, configuration);
  plan.references = pathsOf("references", options.references, configuration, kNoReference);
  plan.configurations = pathsOf("configurations", options.configurations, configuration);
  if (!plan.references.empty() && plan.references.size() != plan.recordings.size())
    throw configuration.invalidValue(
        kSection, "references",
        fmt::format("must name a file or none for each of the {} recordings, in their order", plan.recordings.size()));
  return plan;
}

/** Each run once per value, with that value assigned. */
std::vector<PlannedRun> times(const std::vector<PlannedRun>& runs, std::size_t values,
                              const std::function<void(PlannedRun&, std::size_t)>& assign)
{
  std::vector<PlannedRun> product;
  for (const PlannedRun& run : runs)
    for (std::size_t i = 0; i < values; ++i)
    {
      product.push_back(run);
      assign(product.back(), i);
    }
  return product;
}

std::vector<std::pair<std::string, std::string>> heldFixed(const Configuration& configuration,
                                                           const std::vector<AxisOptions>& axes)
{
  std::vector<std::pair<std::string, std::string>> settings;
  for (const std::string& section : sectionsForRuns(configuration))
    for (const std::string& key : configuration.keys(section))
    {
      const std::string name = section + '.' + key;
      const bool varied =
          std::any_of(axes.begin(), axes.end(), [&](const auto& axis) { return sameName(axis.name, name); });
      if (!varied) settings.emplace_back(name, configuration.text(section, key));
    }
  return settings;
}

/** Each simulated run once per seed; a recording has no seed. */
std::vector<PlannedRun> timesSeeds(const std::vector<PlannedRun>& runs, const std::vector<std::uint64_t>& seeds)
{
  std::vector<PlannedRun> product;
  for (const PlannedRun& run : runs)
  {
    const auto seeded = times({run}, run.recording.empty() ? seeds.size() : 1,
                              [&](PlannedRun& r, std::size_t i) { r.seed = r.recording.empty() ? seeds[i] : 0; });
    product.insert(product.end(), seeded.begin(), seeded.end());
  }
  return product;
}
}  // namespace

bool findTheDrive(const std::vector<std::filesystem::path>& configurations)
{
  return std::any_of(configurations.begin(), configurations.end(),
                     [](const auto& file)
                     { return contentOf(file).find("$env{SCANLOOM_RECORDING}") != std::string::npos; });
}

std::vector<std::string> sectionsForRuns(const Configuration& configuration)
{
  std::vector<std::string> sections = configuration.sections();
  sections.erase(std::remove_if(sections.begin(), sections.end(), [](const auto& s) { return sameName(s, kSection); }),
                 sections.end());
  return sections;
}

std::string PlannedRun::label() const
{
  std::string text = fmt::format("{} {} n{}", stand, lidars, every_nth);
  std::replace(text.begin(), text.end(), ',', '+');
  if (seed > 0) text += fmt::format(" seed {}", seed);
  return text;
}

ExperimentPlan planOf(const ExperimentSettings& settings, const Configuration& configuration)
{
  const ExperimentOptions& options = settings.experiment;
  const auto complain = [&](const std::string& key, const std::string& constraint)
  { return configuration.invalidValue(kSection, key, constraint); };

  ExperimentPlan plan = filesNamedIn(options, configuration);
  auto& runs = plan.runs;
  runs = drivesIn(plan);
  if (runs.empty()) throw complain("simulations", "simulations or recordings must name what runs");

  for (PlannedRun& run : runs) run.settings = heldFixed(configuration, settings.axes);

  const std::vector<std::string> lidars = wordsOf(options.lidars);
  if (lidars.empty()) throw complain("lidars", "must have at least one set of lidars");
  runs = times(runs, lidars.size(), [&](PlannedRun& run, std::size_t i) { run.lidars = lidars[i]; });
  const std::vector<int> counts = countsOf(options.every_nth, configuration);
  runs = times(runs, counts.size(), [&](PlannedRun& run, std::size_t i) { run.every_nth = counts[i]; });
  for (std::size_t a = 0; a < settings.axes.size(); ++a)
  {
    const AxisOptions& axis = settings.axes[a];
    if (axis.name.empty()) continue;
    const std::vector<std::string> values = valuesOf(axis.values);
    if (values.empty())
      throw complain(numbered("axis", a) + "name",
                     fmt::format("{}values must name at least one value", numbered("axis", a)));
    runs = times(runs, values.size(),
                 [&](PlannedRun& run, std::size_t i) { run.settings.emplace_back(axis.name, values[i]); });
  }
  runs = timesSeeds(runs, seedsOf(options.seeds, configuration));
  return plan;
}

ExperimentOptions withAbsolutePaths(ExperimentOptions options, const ExperimentPlan& plan)
{
  const auto absolute = [](const std::vector<std::filesystem::path>& paths)
  {
    std::vector<std::string> words;
    for (const auto& path : paths)
      words.push_back(path == kNoReference ? path.string() : std::filesystem::absolute(path).string());
    return fmt::format("{}", fmt::join(words, " "));
  };
  options.simulations = absolute(plan.simulations);
  options.recordings = absolute(plan.recordings);
  options.references = absolute(plan.references);
  options.configurations = absolute(plan.configurations);
  return options;
}
}  // namespace scanloom
