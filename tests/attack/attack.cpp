/**
 * Damages one sound file at a time and gives it to a verb: `scanloom_attack SCANLOOM --seconds 30`, where SCANLOOM is
 * the program or, ten times faster, libscanloom_program.so. No verb may crash, hang, take more memory than ten times
 * the file and what it takes for a sound one (at least 200 MB), or fail without a word, or send control characters to
 * the terminal. The same seed gives the same damage. Status 1 if there are findings; their files are kept. Of a program
 * with sanitizers, whose shadow takes terabytes of addresses, memory is not limited.
 */
#include "LimitedRun.h"
#include "World.h"
#include "mutate.h"
#include "support/TemporaryFolder.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>

using namespace scanloom;
namespace fs = std::filesystem;

namespace
{
constexpr std::uint64_t kMegabyte = 1'000'000;
#ifdef SCANLOOM_SANITIZED
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif
constexpr RunLimits kForSound{120, 600, kSanitized ? 0 : std::uint64_t{8} << 30};
constexpr std::uint64_t kMostAddresses = kSanitized ? 0 : std::uint64_t{6} << 30;

struct Arguments
{
  fs::path scanloom, folder;
  double seconds = 30;
  std::uint64_t seed = 1, first = 0;
  std::string only;
};

class Attack
{
 public:
  explicit Attack(Arguments arguments)
    : arguments_(std::move(arguments)), world_(fs::absolute(arguments_.folder) / "world"), sound_(targets().size())
  {
    fs::create_directories(world_ / "hit");
    for (std::size_t i = 0; i < targets().size(); ++i)
      if (targets()[i].name().find(arguments_.only) != std::string::npos) chosen_.push_back(i);
    if (chosen_.empty()) throw std::runtime_error("--only " + arguments_.only + ": no target has this in its name");
    makeWorld(arguments_.scanloom, world_);
  }

  /** Target after target until the time is over. @return the number of findings. */
  int run()
  {
    const auto begin = std::chrono::steady_clock::now();
    const auto seconds = [&]
    { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
    int findings = 0;
    std::uint64_t number = arguments_.first;
    for (; seconds() < arguments_.seconds; ++number) findings += hit(number) ? 1 : 0;
    fmt::print("{} damaged files of {} targets in {:.0f} s: {} findings; next: --first {}\n", number - arguments_.first,
               chosen_.size(), seconds(), findings, number);
    return findings;
  }

 private:
  /** @return whether it is a finding. */
  bool hit(std::uint64_t number)
  {
    const std::size_t index = chosen_[number % chosen_.size()];
    const Target& target = targets()[index];
    const RunResult& sound = soundRunOf(index);
    std::seed_seq seed{arguments_.seed, static_cast<std::uint64_t>(index), number};
    std::mt19937_64 random(seed);
    const fs::path file = world_ / "hit" / fs::path(target.file).filename();
    std::ofstream(file, std::ios::binary) << mutated(contentOf(world_ / target.file), target.content, random);

    const RunLimits limits{10 + 10 * sound.cpu_seconds, 300, kMostAddresses};
    const RunResult result = runOn(target, file, limits);
    const std::optional<std::string> fault = faultOf(result, sound, fs::file_size(file));
    if (!fault) return false;
    const fs::path kept = world_.parent_path() / fmt::format("finding-{}-{}", number, file.filename().string());
    fs::copy_file(file, kept, fs::copy_options::overwrite_existing);
    fmt::print("FINDING {}: {}\n  scanloom {}\n  {}\n", number, *fault, target.name(), kept.string());
    std::fflush(stdout);
    return true;
  }

  const RunResult& soundRunOf(std::size_t index)
  {
    std::optional<RunResult>& sound = sound_[index];
    if (!sound) sound = runOn(targets()[index], world_ / targets()[index].file, kForSound);
    if (sound->signal != 0)
      throw std::runtime_error(targets()[index].name() + " fails on sound files: " + sound->errors);
    return *sound;
  }

  RunResult runOn(const Target& target, const fs::path& file, const RunLimits& limits) const
  {
    fs::remove_all(world_ / "out");
    fs::create_directories(world_ / "out");
    std::string arguments = target.arguments;
    for (std::size_t at = 0; (at = arguments.find("{}", at)) != std::string::npos;)
      arguments.replace(at, 2, file.string());
    std::vector<std::string> command = wordsOf(arguments);
    command.insert(command.begin(), arguments_.scanloom.string());
    return limitedRun(command, world_, limits);
  }

  static std::optional<std::string> faultOf(const RunResult& run, const RunResult& sound, std::uintmax_t size)
  {
    const std::uint64_t most = std::max(200 * kMegabyte, sound.peak_bytes) + 10 * size;
    if (run.signal == SIGXCPU || run.signal == SIGKILL)
      return fmt::format("does not end within {:.0f} s ({:.0f} s of a core), {:.1f} s for a sound file", run.seconds,
                         run.cpu_seconds, sound.cpu_seconds);
    if (run.signal != 0) return fmt::format("crashes with signal {}: {}", run.signal, run.errors);
    if (run.errors.find("Sanitizer") != std::string::npos || run.errors.find("runtime error:") != std::string::npos)
      return run.errors;
    if ((!kSanitized && run.peak_bytes > most) || run.errors.find("bad_alloc") != std::string::npos)
      return fmt::format("takes {} MB for a file of {:.1f} MB, {} MB for a sound one", run.peak_bytes / kMegabyte,
                         1e-6 * static_cast<double>(size), sound.peak_bytes / kMegabyte);
    constexpr std::array kStatus{0, 1, 2, 3};
    if (std::find(kStatus.begin(), kStatus.end(), run.status) == kStatus.end())
      return fmt::format("ends with status {}", run.status);
    if ((run.status == 1 || run.status == 2) && run.errors.empty()) return "fails without a word";
    const auto is_control = [](unsigned char c)
    { return (c < ' ' && c != '\n' && c != '\t' && c != '\r') || c == 0x7F; };
    if (std::any_of(run.errors.begin(), run.errors.end(), is_control))
      return "sends control characters to the terminal";
    return std::nullopt;
  }

  Arguments arguments_;
  fs::path world_;
  std::vector<std::size_t> chosen_;
  std::vector<std::optional<RunResult>> sound_;  // of the sound file of each target, when first needed
};

/** Removed at the end unless there are findings. */
fs::path temporaryFolder()
{
  std::string name = (fs::temp_directory_path() / "scanloom_attack_XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  return name;
}
}  // namespace

int main(int argc, char** argv)
try
{
  Arguments arguments;
  CLI::App app("Gives damaged files to every verb of scanloom.");
  app.add_option("SCANLOOM", arguments.scanloom, "the program, or libscanloom_program.so")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--seconds", arguments.seconds, "how long, in s, after the sound files are made")
      ->capture_default_str();
  app.add_option("--seed", arguments.seed, "of the damage")->capture_default_str();
  app.add_option("--first", arguments.first, "number of the first damage, to repeat a finding")->capture_default_str();
  app.add_option("--only", arguments.only, "targets with this text in their names, for example 'edit' or '.rawlog'");
  app.add_option("--folder", arguments.folder, "where to work and to keep what is found; default: a temporary one");
  CLI11_PARSE(app, argc, argv);
  arguments.scanloom = fs::absolute(arguments.scanloom);
  const bool temporary = arguments.folder.empty();
  if (temporary) arguments.folder = temporaryFolder();
  const int findings = Attack(arguments).run();
  fs::remove_all(arguments.folder / "world");
  if (temporary && findings == 0) fs::remove_all(arguments.folder);
  return findings == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
catch (const std::exception& e)
{
  fmt::print(stderr, "scanloom_attack: {}\n", e.what());
  return EXIT_FAILURE;
}
