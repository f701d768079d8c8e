/** `scanloom edit`: one operation on a rawlog. */
#include "Arguments.h"
#include "Options.h"
#include "Verb.h"
#include "base/core/ConfigError.h"
#include "base/core/Interruption.h"
#include "base/core/OutputFile.h"
#include "base/core/OutputFolder.h"
#include "base/core/Progress.h"
#include "base/core/jsonText.h"
#include "base/formats/FileFormat.h"
#include "mrpt/edit/EditOperations.h"
#include "mrpt/edit/namesOfExport.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct EditArguments
{
  std::filesystem::path input, output;
  bool overwrite = false, quiet = false;
  EditOptions options;
};

/** Throws UsageError unless there is one operation; a cut may come before one that streams the rawlog. */
void requireOne(const std::vector<EditOperation>& operations)
{
  std::vector<std::string> names;
  for (const EditOperation& operation : operations)
    if (operation.option != "cut") names.push_back(operation.option);

  if (names.empty() && operations.empty()) throw UsageError("no operation is given: see 'scanloom edit --help'");
  if (names.size() > 1)
    throw UsageError(fmt::format("one operation a call, not {}: use the output of one as the input of the next",
                                 fmt::join(names, ", ")));
}

/** MRPT would call them damaged rawlogs. */
void refuseCaptures(const std::filesystem::path& input)
{
  if (formatOfFile(input) != FileFormat::Other)
    throw UsageError(
        fmt::format("{}: is a capture or a bag, not a rawlog: 'scanloom record' makes one of it", input.string()));
}

void refuseExistingOutputs(const EditArguments& arguments, const EditOperation& operation)
{
  refuseExisting(operation.outputs.files, arguments.overwrite);
  const auto& folder = operation.outputs.folder;
  if (!folder.empty() && std::filesystem::exists(folder) && !arguments.overwrite)
    if (!std::filesystem::is_directory(folder) || !std::filesystem::is_empty(folder))
      throw UsageError(fmt::format("{} {}: must be a new or an empty folder; -w writes into it all the same",
                                   operation.option, folder.string()));
}

KeepReading showingProgress(const EditArguments& arguments)
{
  if (arguments.quiet) return [](std::uint64_t) { return !interrupted(); };
  auto progress = std::make_shared<Progress>("edit", megabytesOf({arguments.input}), "MB");
  return [progress](std::uint64_t bytes)
  {
    progress->update(bytes / 1000000);
    return !interrupted();
  };
}

void report(const std::string& what, bool to_rawlog, const RawlogEdited& edited)
{
  if (!edited.damage.empty())
    fmt::print(stderr, "damaged: {}: read up to there, {} observations\n", edited.damage, edited.read());
  if (edited.stopped) fmt::print(stderr, "interrupted: what was written is {}\n", edited.output.string());
  if (edited.passed_over > 0)
    fmt::print(stderr, "warning: {} objects are no observations (actions, maps): they are not in the output\n",
               edited.passed_over);
  if (!to_rawlog)
  {
    fmt::print("{}: {} observations read\n{}\n", what, edited.read(), edited.output.string());
    return;
  }
  fmt::print("{}: {} observations read, {} written\n", what, edited.read(), edited.written());
  for (const auto& [label, count] : edited.labels)
    fmt::print("  {:<20} {:>8} -> {}\n", label.empty() ? "(no label)" : label, count.read, count.written);
}

void refuseToReplaceInputs(const EditArguments& arguments, const std::vector<EditOperation>& operations)
{
  std::vector<std::filesystem::path> inputs{arguments.input};
  for (const EditOperation& operation : operations)
    inputs.insert(inputs.end(), operation.inputs.begin(), operation.inputs.end());
  refuseInputsAsOutputs(inputs, {arguments.output});
  refuseInputsAsOutputs(inputs, operations.back().outputs.files);
}

Completeness completenessOf(const RawlogEdited& edited)
{
  return edited.stopped ? Completeness::Partial : Completeness::Whole;
}

RawlogEdited exportFiles(const EditArguments& arguments, const std::vector<EditOperation>& operations)
{
  const EditOutputs& outputs = operations.back().outputs;
  const auto exportTo = [&](const EditOutputs& running)
  { return readRawlog(arguments.input, chained(operations, arguments.input, running), showingProgress(arguments)); };
  if (outputs.folder.empty())
  {
    OutputFile file(outputs.files.front());
    RawlogEdited edited = exportTo({{file.temporary()}, {}});
    edited.output = file.commit(completenessOf(edited));
    return edited;
  }
  OutputFolder folder(outputs.folder);
  RawlogEdited edited = exportTo({{}, folder.running()});
  edited.output = folder.commit(namesOfExport(outputs.folder, folder.running()), completenessOf(edited));
  return edited;
}

int edit(const EditArguments& arguments, const std::vector<EditOperation>& operations)
{
  const bool to_rawlog = operations.back().writesRawlog();
  if (to_rawlog && arguments.output.empty()) throw UsageError("-o/--output is required: the rawlog to write");
  if (!to_rawlog && !arguments.output.empty())
    throw UsageError(fmt::format("{} writes no rawlog: it takes no -o/--output", operations.back().option));
  if (to_rawlog) refuseExisting({arguments.output}, arguments.overwrite);
  for (const EditOperation& operation : operations) refuseExistingOutputs(arguments, operation);
  refuseToReplaceInputs(arguments, operations);
  refuseCaptures(arguments.input);

  catchInterruption();
  const RawlogEdited edited = to_rawlog ? editRawlog(arguments.input, chained(operations, arguments.input, {}),
                                                     arguments.output, showingProgress(arguments))
                                        : exportFiles(arguments, operations);
  report(operations.back().option, to_rawlog, edited);
  if (interrupted()) return kInterrupted;
  return edited.damage.empty() && edited.passed_over == 0 ? kDone : kQualityGate;
}

int run(const EditArguments& arguments)
{
  const std::vector<EditOperation> operations =
      editOperations(arguments.options, arguments.input, [](const std::string& line) { std::cerr << line << '\n'; });
  requireOne(operations);
  return edit(arguments, operations);
}

/** Options under one heading of --help. */
class OptionGroup
{
 public:
  OptionGroup(CLI::App& app, std::string heading) : app_(app), heading_(std::move(heading)) {}

  template <typename Value>
  const Option add(const std::string& name, Value& value, const std::string& type, const std::string& meaning)
  {
    return addOption(app_, name, value, meaning).typeName(type).group(heading_);
  }
  void add(const std::string& name, bool& flag, const std::string& meaning)
  {
    addFlag(app_, name, flag, meaning).group(heading_);
  }

 private:
  CLI::App& app_;
  std::string heading_;
};

void addCut(CLI::App& app, EditOptions& o)
{
  OptionGroup group(app, "Part of the input, alone or before an operation");
  group.add("--from-time", o.from_time, "S", "from this stamp on, in s since 1970 (a scan's stamp is its start)");
  group.add("--to-time", o.to_time, "S", "up to and including this stamp");
  group.add("--from-index", o.from_index, "N", "from this object on; the first is 0");
  group.add("--to-index", o.to_index, "N", "up to and including this object");
}

void addChoicesOfObservations(OptionGroup& group, EditOptions& o)
{
  group.add("--keep-label", o.keep_label, "L,...", "keep observations with these labels, and the header")
      .commaSeparated();
  group.add("--remove-label", o.remove_label, "L,...", "remove observations with these labels").commaSeparated();
  group.add("--split-lidars", o.split_lidars, "split each cloud into one per lidar, 'lidar_<name>'");
  group.add("--merge-lidars", o.merge_lidars, "merge clouds that --split-lidars made, points in time order");
  group.add("--keep-lidars", o.keep_lidars, "NAME,...", "keep points and IMUs of these lidars only").commaSeparated();
  group.add("--keep-every", o.keep_every, "N", "keep every N-th scan, and everything that is not a scan").positive();
  group.add("--time-offset", o.time_offset, "LABEL=S", "add S seconds to the stamps of this label");
  group.add("--rebatch", o.rebatch, "HZ", "divide the points into scans at this rate, in Hz").between(0.1, 1000.0);
}

void addChangesOfPoints(OptionGroup& group, EditOptions& o)
{
  group.add("--crop-box", o.crop_box, "\"X0 Y0 Z0 X1 Y1 Z1\"", "remove points inside this box of the body frame, in m");
  group.add("--ranges", o.ranges, "\"M0 M1\"", "remove points nearer than M0 to their lidar or farther than M1, in m");
  group.add("--voxel", o.voxel, "M", "keep the first point in each cube with this edge, in m").positive();
  group.add("--apply-extrinsics", o.apply_extrinsics, "FILE",
            "change the poses of the sensors: lines 'T_body_<name> ...', or a configuration (.ini)");
  group.add("--convert-clouds", o.convert_clouds, "CLASS", "convert clouds to CGenericPointsMap or CPointsMapXYZI");
  group.add("--deskew", o.deskew, "FILE|imu[=LABEL]",
            "move points to where they are at their cloud's stamp, by a trajectory (TUM, EuRoC or KITTI), or by an IMU "
            "of the rawlog (label: imu), which corrects the rotation only");
}

void addFiles(OptionGroup& group, EditOptions& o)
{
  group.add("--export", o.export_as, "FORMAT=PATH",
            "write files: ply=DIR, pcd=DIR, kitti=DIR (.bin), a file per cloud in a folder per label; csv=DIR, IMU "
            "samples as EuRoC csv and stamps of clouds; tum=FILE, poses in the rawlog");
  group.add("--to-mcap", o.to_mcap, "FILE",
            "write clouds, IMU and poses as an MCAP file, which Foxglove and ROS 2 play; poses of the rawlog, or of "
            "--trajectory");
  group.add("--trajectory", o.trajectory, "FILE",
            "for --to-mcap: poses of the body as TUM, EuRoC (.csv) or KITTI (times.txt beside it)");
}

std::function<int()> addEditOptions(CLI::App& app)
{
  auto arguments = std::make_shared<EditArguments>();
  addOption(app, "-i,--input", arguments->input, "the rawlog to read").required().typeName("FILE");
  addOption(app, "-o,--output", arguments->output, "the rawlog to write").typeName("FILE");
  addOverwrite(app, arguments->overwrite);
  addFlag(app, "-q,--quiet", arguments->quiet, "show no progress");
  OptionGroup group(app, "Operations");
  addCut(app, arguments->options);
  addChoicesOfObservations(group, arguments->options);
  addChangesOfPoints(group, arguments->options);
  addFiles(group, arguments->options);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb editVerb()
{
  return {"edit", "one operation on a rawlog: cut, split, thin, convert, export", {}, &addEditOptions};
}
}  // namespace scanloom
