/** `scanloom edit`: one operation on a rawlog, object by object. */
#include "Arguments.h"
#include "EditOperations.h"
#include "Interruption.h"
#include "Progress.h"
#include "Verb.h"
#include "config/AtomicFile.h"
#include "config/ConfigError.h"
#include "dataset/CloudObservation.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct EditArguments
{
  std::filesystem::path input, output;
  bool overwrite = false, dry_run = false, json = false, quiet = false;
  EditOptions options;
};

/** A cut may go before an operation; but for that there is one. */
void requireOne(const std::vector<EditOperation>& operations)
{
  const auto is_cut = [](const EditOperation& operation) { return operation.option == "cut"; };
  const auto cuts = std::count_if(operations.begin(), operations.end(), is_cut);
  if (operations.empty()) throw UsageError("no operation is given: see 'scanloom edit --help'");
  if (operations.size() - static_cast<std::size_t>(cuts) <= 1) return;
  std::string names;
  for (const EditOperation& operation : operations)
    if (!is_cut(operation)) names += (names.empty() ? "" : ", ") + operation.option;
  throw UsageError(fmt::format("one operation a call, not {}: the result of one is the input of the next", names));
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

void report(const EditArguments& arguments, const RawlogEdited& edited)
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
  fmt::print("{} observations read, {} in {}\n", edited.read(), edited.written(), arguments.output.string());
  for (const auto& [label, count] : edited.labels)
    fmt::print("  {:<20} {:>8} -> {}\n", label.empty() ? "(no label)" : label, count.read, count.written);
}

int run(const EditArguments& arguments)
{
  const std::vector<EditOperation> operations = chosenOperations(arguments.options);
  requireOne(operations);
  if (arguments.output.empty()) throw UsageError("-o/--output is required: the rawlog to write");
  refuseExisting({arguments.output}, arguments.overwrite);
  const RawlogOperation operation = made(operations, arguments.input);
  if (arguments.dry_run)
  {
    for (const EditOperation& each : operations) fmt::print("{} ", each.option);
    fmt::print("from {} into {}\n", arguments.input.string(), arguments.output.string());
    return kDone;
  }

  catchInterruption();
  const RawlogEdited edited = editRawlog(arguments.input, operation, arguments.output, keepReading(arguments));
  report(arguments, edited);
  if (interrupted()) return kInterrupted;
  return edited.damage.empty() && edited.passed_over == 0 ? kDone : kQualityGate;
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<EditArguments>();
  app.add_option("-i,--input", arguments->input, "the rawlog to read")->required()->type_name("FILE");
  app.add_option("-o,--output", arguments->output, "the rawlog to write")->type_name("FILE");
  addOverwrite(app, arguments->overwrite);
  app.add_flag("--dry-run", arguments->dry_run, "check everything, print what would run, and stop");
  app.add_flag("-q,--quiet", arguments->quiet, "no progress");
  addJson(app, arguments->json);
  addEditOptions(app, arguments->options);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb editVerb() { return {"edit", "one operation on a rawlog: cut, split, thin, convert, check", {}, &addOptions}; }
}  // namespace scanloom
