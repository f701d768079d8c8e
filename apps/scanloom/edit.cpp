/** `scanloom edit`: one operation on a rawlog, object by object. */
#include "Arguments.h"
#include "EditOperations.h"
#include "Interruption.h"
#include "Progress.h"
#include "RawlogReport.h"
#include "Settings.h"
#include "Verb.h"
#include "config/AtomicFile.h"
#include "config/ConfigError.h"
#include "dataset/CloudObservation.h"
#include "dataset/DoctorFindings.h"
#include "dataset/DoctorJson.h"
#include "dataset/RawlogCheck.h"
#include "dataset/RawlogEvidence.h"
#include "dataset/RawlogFromCaptures.h"
#include "mrpt_bridge/SensorInput.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct EditArguments
{
  ConfigurationArguments configuration;
  std::filesystem::path input, output;
  bool overwrite = false, json = false, quiet = false;
  bool info = false, check = false, approach_a = false;
  std::vector<std::string> from_pcap;
  EditOptions options;
};

struct NoSettings
{
  template <typename Self, typename Visitor>
  static void sections(Self&, Visitor&&)
  {
  }
};

/** A cut may go before an operation that passes the rawlog; but for that there is one. */
void requireOne(const EditArguments& arguments, const std::vector<EditOperation>& operations)
{
  std::vector<std::string> names;
  if (arguments.info) names.emplace_back("--info");
  if (arguments.check) names.emplace_back("--check");
  if (!arguments.from_pcap.empty()) names.emplace_back("--from-pcap");
  const bool may_be_cut = names.empty();
  for (const EditOperation& operation : operations)
    if (operation.option != "cut" || !may_be_cut) names.push_back(operation.option);

  if (names.empty() && operations.empty()) throw UsageError("no operation is given: see 'scanloom edit --help'");
  if (names.size() > 1)
    throw UsageError(fmt::format("one operation a call, not {}: the result of one is the input of the next",
                                 fmt::join(names, ", ")));
  if (arguments.input.empty() == arguments.from_pcap.empty())
    throw UsageError("-i/--input is required: the rawlog to read, but for --from-pcap, which reads captures");
  if (arguments.approach_a && arguments.from_pcap.empty())
    throw UsageError("--approach-a puts whole turns together, which only captures hold: it goes with --from-pcap");
}

bool writesRawlog(const std::vector<EditOperation>& operations)
{
  return operations.back().files.empty() && operations.back().folder.empty();
}

void refuseExistingOutputs(const EditArguments& arguments, const EditOperation& operation)
{
  refuseExisting(operation.files, arguments.overwrite);
  const auto& folder = operation.folder;
  if (!folder.empty() && std::filesystem::exists(folder) && !arguments.overwrite)
    if (!std::filesystem::is_directory(folder) || !std::filesystem::is_empty(folder))
      throw UsageError(
          fmt::format("{} {}: is no empty folder; -w writes into it all the same", operation.option, folder.string()));
}

RawlogOperation made(const std::vector<EditOperation>& operations, const std::filesystem::path& input)
{
  const std::optional<RecordingHeader> header = headerOf(input);
  RawlogOperation all = operations.front().make(header);
  for (std::size_t i = 1; i < operations.size(); ++i) all = chained(std::move(all), operations[i].make(header));
  return all;
}

/** Shows how much of the file was read; quiet: nothing. */
KeepReading keepReading(const EditArguments& arguments)
{
  if (arguments.quiet) return [](std::uint64_t) { return !interrupted(); };
  auto progress = std::make_shared<Progress>("edit", megabytesOf({arguments.input}), "MB");
  return [progress](std::uint64_t bytes)
  {
    progress->update(bytes / 1000000);
    return !interrupted();
  };
}

void report(const EditArguments& arguments, const std::string& what, const RawlogEdited& edited)
{
  if (!edited.damage.empty())
    fmt::print(stderr, "damaged: {}: read up to there, {} observations\n", edited.damage, edited.read());
  if (edited.passed_over > 0)
    fmt::print(stderr, "warning: {} objects are no observations (actions, maps): they are not in the output\n",
               edited.passed_over);
  if (arguments.json)
  {
    nlohmann::json labels = nlohmann::json::object();
    for (const auto& [label, count] : edited.labels) labels[label] = {{"read", count.read}, {"written", count.written}};
    const nlohmann::json result = {{"labels", labels},
                                   {"read", edited.read()},
                                   {"written", edited.written()},
                                   {"passed_over", edited.passed_over},
                                   {"damage", edited.damage}};
    std::cout << result.dump(2) << '\n';
    return;
  }
  fmt::print("{}: {} observations read, {} written\n", what, edited.read(), edited.written());
  for (const auto& [label, count] : edited.labels)
    fmt::print("  {:<20} {:>8} -> {}\n", label.empty() ? "(no label)" : label, count.read, count.written);
}

int edit(const EditArguments& arguments, const std::vector<EditOperation>& operations)
{
  const bool to_rawlog = writesRawlog(operations);
  if (to_rawlog && arguments.output.empty()) throw UsageError("-o/--output is required: the rawlog to write");
  if (!to_rawlog && !arguments.output.empty())
    throw UsageError(fmt::format("{} writes no rawlog: -o/--output has no meaning", operations.back().option));
  if (to_rawlog) refuseExisting({arguments.output}, arguments.overwrite);
  for (const EditOperation& operation : operations) refuseExistingOutputs(arguments, operation);
  if (arguments.configuration.dry_run)
  {
    if (to_rawlog) made(operations, arguments.input);  // others would begin their files
    for (const EditOperation& each : operations) fmt::print("{} ", each.option);
    fmt::print("of {}{}\n", arguments.input.string(), to_rawlog ? " into " + arguments.output.string() : "");
    return kDone;
  }

  catchInterruption();
  const RawlogOperation operation = made(operations, arguments.input);
  const KeepReading keep_reading = keepReading(arguments);
  const RawlogEdited edited = to_rawlog ? editRawlog(arguments.input, operation, arguments.output, keep_reading)
                                        : readRawlog(arguments.input, operation, keep_reading);
  report(arguments, operations.back().option, edited);
  if (interrupted()) return kInterrupted;
  return edited.damage.empty() && edited.passed_over == 0 ? kDone : kQualityGate;
}

int info(const EditArguments& arguments)
{
  const RawlogInfo info = rawlogInfo(arguments.input);
  if (arguments.json)
    std::cout << toJson(info).dump(2) << '\n';
  else
    print(info);
  return info.damage.empty() ? kDone : kQualityGate;
}

int check(const EditArguments& arguments)
{
  catchInterruption();
  const RawlogAccount account = accountOf(arguments.input, keepReading(arguments));
  if (interrupted()) return kInterrupted;
  Findings findings = findingsOf(account);
  RigExamination examination;
  if (account.header)
  {
    examination = examine(rawlogEvidence(arguments.input).rig, {});
    const Findings of_rig = findingsOf(examination, {});
    findings.insert(findings.end(), of_rig.begin(), of_rig.end());
  }
  if (arguments.json)
  {
    auto result = nlohmann::json::parse(toJson(examination, findings));
    result["rawlog"] = nlohmann::json::parse(toJson(account));
    std::cout << result.dump(2) << '\n';
  }
  else
    std::cout << toText(findings) << '\n' << summaryOf(findings) << '\n';
  return worstOf(findings) == Verdict::NotFit ? kQualityGate : kDone;
}

int batchCaptures(const EditArguments& arguments)
{
  if (arguments.configuration.files.empty()) throw UsageError("--from-pcap needs -c CONFIG, which names the lidars");
  if (arguments.output.empty()) throw UsageError("-o/--output is required: the rawlog to write");
  refuseExisting({arguments.output}, arguments.overwrite);
  Loaded<NoSettings> loaded = load<NoSettings>(arguments.configuration);
  const std::string section = rigSection(loaded.configuration);
  loaded.configuration.set(fmt::format("{}.pcap_input={}", section, fmt::join(arguments.from_pcap, ",")));
  if (arguments.approach_a) loaded.configuration.set(section + ".batching=nearest_turns");
  const RigSettings settings = readRigSettings(loaded.configuration, section);
  const Rig rig = makeRig(settings);
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }

  catchInterruption();
  std::optional<Progress> progress;
  const std::uint64_t megabytes = megabytesOf(rig.captures);
  if (!arguments.quiet) progress.emplace("edit", megabytes, "MB");
  const RigAccount account =
      rawlogFromCaptures(rig, settings.driver, arguments.output,
                         [&](double share)
                         {
                           if (progress)
                             progress->update(static_cast<std::uint64_t>(share * static_cast<double>(megabytes)));
                           return !interrupted();
                         });
  progress.reset();
  const auto counts = countsOf(account);
  if (arguments.json)
    std::cout << nlohmann::json{{"counts", counts}}.dump(2) << '\n';
  else
    for (const auto& [what, count] : counts)
      if (count > 0) fmt::print("  {}: {}\n", what, count);
  return interrupted() ? kInterrupted : kDone;
}

int run(const EditArguments& arguments)
{
  const std::vector<EditOperation> operations = chosenOperations(arguments.options, arguments.input);
  requireOne(arguments, operations);
  if (arguments.info) return info(arguments);
  if (arguments.check) return check(arguments);
  if (!arguments.from_pcap.empty()) return batchCaptures(arguments);
  return edit(arguments, operations);
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<EditArguments>();
  app.add_option("-i,--input", arguments->input, "the rawlog to read")->type_name("FILE");
  app.add_option("-o,--output", arguments->output, "the rawlog to write")->type_name("FILE");
  addOverwrite(app, arguments->overwrite);
  addConfiguration(app, arguments->configuration);
  app.add_flag("-q,--quiet", arguments->quiet, "no progress");
  addJson(app, arguments->json);
  app.add_flag("--info", arguments->info, "what the rawlog holds")->group("Operations");
  app.add_flag("--check", arguments->check, "whether it is fit to be used; if not, status 3")->group("Operations");
  app.add_option("--from-pcap", arguments->from_pcap, "a rawlog of these captures and the lidars of -c")
      ->delimiter(',')
      ->type_name("FILE,...")
      ->group("Operations");
  app.add_flag("--approach-a", arguments->approach_a,
               "with --from-pcap: whole turns behind each other, the paper's approach A, for comparison")
      ->group("Operations");
  addEditOptions(app, arguments->options);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb editVerb()
{
  return {"edit", "one operation on a rawlog: cut, split, thin, convert, export, check", rigSchema("lidars"),
          &addOptions};
}
}  // namespace scanloom
