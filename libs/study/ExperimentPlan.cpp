#include "study/ExperimentPlan.h"

#include "study/ContentHash.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <iterator>
#include <optional>
#include <sstream>

namespace scanloom
{
namespace
{
constexpr const char* kSection = "experiment";

std::vector<std::string> wordsOf(const std::string& text)
{
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::vector<std::string> valuesOf(const std::string& text)
{
  std::vector<std::string> values;
  std::istringstream stream(text);
  for (std::string value; std::getline(stream, value, '|');) values.emplace_back(trimmed(value));
  return values;
}

template <typename Number>
std::optional<Number> positive(const std::string& text)
{
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1) return std::nullopt;
  return value;
}

std::vector<std::uint64_t> seedsOf(const std::string& text, const Configuration& configuration)
{
  constexpr std::uint64_t kMost = 100000;
  const auto refuse = [&]
  { return configuration.complaint(kSection, "seeds", "must be whole numbers from 1 on, or first:last"); };
  std::vector<std::uint64_t> seeds;
  for (const std::string& word : wordsOf(text))
  {
    const std::size_t colon = std::min(word.find(':'), word.size());
    const auto first = positive<std::uint64_t>(word.substr(0, colon));
    const auto last = colon == word.size() ? first : positive<std::uint64_t>(word.substr(colon + 1));
    if (!first || !last || *last < *first || *last - *first > kMost) throw refuse();
    for (std::uint64_t seed = *first; seed <= *last; ++seed) seeds.push_back(seed);
  }
  if (seeds.empty()) throw refuse();
  return seeds;
}

std::vector<int> countsOf(const std::string& text, const Configuration& configuration)
{
  std::vector<int> counts;
  for (const std::string& word : wordsOf(text))
  {
    const auto count = positive<int>(word);
    if (!count) throw configuration.complaint(kSection, "every_nth", "must be whole numbers from 1 on");
    counts.push_back(*count);
  }
  if (counts.empty()) throw configuration.complaint(kSection, "every_nth", "must have at least one number");
  return counts;
}

/** Relative paths start at the folder of the file that names them; those of --set at the current folder. */
std::vector<std::filesystem::path> pathsOf(const std::string& key, const std::string& text,
                                           const Configuration& configuration)
{
  std::vector<std::filesystem::path> paths;
  for (const std::string& word : wordsOf(text))
  {
    const Place place = configuration.place(kSection, key);
    const auto folder = place.line > 0 ? std::filesystem::path(place.file).parent_path() : std::filesystem::path();
    paths.push_back((folder / word).lexically_normal());
    if (!std::filesystem::exists(paths.back()))
      throw configuration.complaint(kSection, key, fmt::format("'{}' does not exist", paths.back().string()));
  }
  return paths;
}

/** `sparse` for "recordings/sparse/" and for "stands/sparse.ini". */
std::string standOf(const std::filesystem::path& path)
{
  return path.has_stem() ? path.stem().string() : path.parent_path().filename().string();
}

PlannedRun onSimulation(const std::filesystem::path& file)
{
  PlannedRun run;
  run.stand = standOf(file);
  run.simulation = file;
  return run;
}

PlannedRun onRecording(const std::filesystem::path& folder)
{
  PlannedRun run;
  run.stand = standOf(folder);
  run.recording = folder;
  return run;
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

/** Without this variable every run would read the same packets, or wait for live lidars. */
bool readsTheDrive(const std::vector<std::filesystem::path>& configurations)
{
  return std::any_of(configurations.begin(), configurations.end(),
                     [](const auto& file)
                     { return contentOf(file).find("$env{SCANLOOM_RECORDING}") != std::string::npos; });
}

std::string namesAndSizes(const std::filesystem::path& folder)
{
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file())
      files.push_back(fmt::format("{} {}", entry.path().filename().string(), entry.file_size()));
  std::sort(files.begin(), files.end());
  return fmt::format("{}", fmt::join(files, "\n"));
}
}  // namespace

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
  { return configuration.complaint(kSection, key, constraint); };
  const auto paths = [&](const std::string& key, const std::string& text) { return pathsOf(key, text, configuration); };

  ExperimentPlan plan;
  plan.configurations = paths("configurations", options.configurations);
  if (!readsTheDrive(plan.configurations))
    throw complain("configurations", "must find the drive by $env{SCANLOOM_RECORDING}, as dual_os0_recording.ini does");
  plan.simulations = paths("simulations", options.simulations);
  plan.recordings = paths("recordings", options.recordings);
  auto& runs = plan.runs;
  for (const auto& file : plan.simulations) runs.push_back(onSimulation(file));
  for (const auto& folder : plan.recordings) runs.push_back(onRecording(folder));
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

void refuseUnknownSettings(const ExperimentPlan& plan, const Schema& known)
{
  for (const PlannedRun& run : plan.runs)
  {
    Configuration configuration;
    for (const auto& [name, value] : run.settings) configuration.set(name + '=' + value);
    configuration.refuseUnknown(known);
  }
}

ExperimentOptions withAbsolutePaths(ExperimentOptions options, const ExperimentPlan& plan)
{
  const auto absolute = [](const std::vector<std::filesystem::path>& paths)
  {
    std::vector<std::string> words;
    for (const auto& path : paths) words.push_back(std::filesystem::absolute(path).string());
    return fmt::format("{}", fmt::join(words, " "));
  };
  options.simulations = absolute(plan.simulations);
  options.recordings = absolute(plan.recordings);
  options.configurations = absolute(plan.configurations);
  return options;
}

std::string configurationHash(const PlannedRun& run, const ExperimentPlan& plan, const std::string& version)
{
  std::string all = version + '\n' + run.label() + '\n';
  for (const auto& [name, value] : run.settings) all += fmt::format("{}={}\n", name, value);
  for (const auto& file : plan.configurations) all += contentOf(file) + '\n';
  all += run.recording.empty() ? contentOf(run.simulation) : namesAndSizes(run.recording);
  return hashOf(all);
}
}  // namespace scanloom
