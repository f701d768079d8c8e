/** `scanloom edit`: one operation on a rawlog. */
#include "Options.h"
#include "Verb.h"
#include "core/AtomicFile.h"
#include "core/ConfigError.h"
#include "core/Interruption.h"
#include "core/Progress.h"
#include "doctor/RawlogCheck.h"
#include "edit/EditOperations.h"
#include "edit/StagedOutputs.h"
#include "info.h"
#include "mrpt_bridge/jsonText.h"
#include "record.h"
#include "recordings/RecognisedRig.h"
#include "rig/RigOptions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
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
  std::vector<std::filesystem::path> from_pcap;
  EditOptions options;
};

/** Throws UsageError unless there is one operation; a cut may come before one that streams the rawlog. */
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
    throw UsageError(fmt::format("one operation a call, not {}: use the output of one as the input of the next",
                                 fmt::join(names, ", ")));
  if (arguments.input.empty() == arguments.from_pcap.empty())
    throw UsageError("-i/--input is required: the rawlog to read; only --from-pcap reads captures instead");
  if (arguments.approach_a && arguments.from_pcap.empty())
    throw UsageError("--approach-a merges whole turns, which only captures hold: it needs --from-pcap");
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

void report(const EditArguments& arguments, const std::string& what, bool to_rawlog, const RawlogEdited& edited)
{
  if (!edited.damage.empty())
    fmt::print(stderr, "damaged: {}: read up to there, {} observations\n", edited.damage, edited.read());
  if (edited.stopped) fmt::print(stderr, "interrupted: what was written is {}\n", edited.output.string());
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
    std::cout << jsonText(result) << '\n';
    return;
  }
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

RawlogEdited exportFiles(const EditArguments& arguments, const std::vector<EditOperation>& operations)
{
  StagedOutputs staged(operations.back().outputs);
  RawlogEdited edited =
      readRawlog(arguments.input, chained(operations, arguments.input, staged.running()), showingProgress(arguments));
  const EditOutputs outputs = staged.commit(edited.stopped ? Completeness::Partial : Completeness::Whole);
  edited.output = outputs.files.empty() ? outputs.folder : outputs.files.front();
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
  if (arguments.configuration.dry_run)
  {
    if (to_rawlog) chained(operations, arguments.input, {});  // the others would create their files
    for (const EditOperation& each : operations) fmt::print("{} ", each.option);
    fmt::print("of {}{}\n", arguments.input.string(), to_rawlog ? " into " + arguments.output.string() : "");
    return kDone;
  }

  catchInterruption();
  const RawlogEdited edited = to_rawlog ? editRawlog(arguments.input, chained(operations, arguments.input, {}),
                                                     arguments.output, showingProgress(arguments))
                                        : exportFiles(arguments, operations);
  report(arguments, operations.back().option, to_rawlog, edited);
  if (interrupted()) return kInterrupted;
  return edited.damage.empty() && edited.passed_over == 0 ? kDone : kQualityGate;
}

int check(const EditArguments& arguments)
{
  catchInterruption();
  const CheckedRawlog check = checkRawlog(arguments.input, showingProgress(arguments));
  if (interrupted()) return kInterrupted;
  std::cout << (arguments.json ? toJson(check) : toText(check.findings) + '\n' + summaryOf(check.findings)) << '\n';
  return worstOf(check.findings) == Verdict::NotFit ? kQualityGate : kDone;
}

int recordCaptures(const EditArguments& arguments)
{
  if (arguments.output.empty()) throw UsageError("-o/--output is required: the rawlog to write");
  const Configuration configuration = Configuration::fromFiles(arguments.configuration.files);
  const std::string section = hasRigSection(configuration) ? rigSection(configuration) : kRecognisedSection;
  RecordArguments record_arguments;
  record_arguments.configuration = arguments.configuration;
  record_arguments.output = arguments.output;
  record_arguments.overwrite = arguments.overwrite;
  record_arguments.json = arguments.json;
  record_arguments.quiet = arguments.quiet;
  record_arguments.recording.paths = arguments.from_pcap;
  if (arguments.approach_a) record_arguments.configuration.assignments.push_back(section + ".batching=nearest_turns");
  return record(record_arguments);
}

int run(const EditArguments& arguments)
{
  const std::vector<EditOperation> operations =
      editOperations(arguments.options, arguments.input, [](const std::string& line) { std::cerr << line << '\n'; });
  requireOne(arguments, operations);
  if (arguments.info) return printRawlogInfo(arguments.input, arguments.json);
  if (arguments.check) return check(arguments);
  if (!arguments.from_pcap.empty()) return recordCaptures(arguments);
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
  group.add("--merge-lidars", o.merge_lidars, "the inverse: merge the lidars' clouds, points in time order");
  group.add("--keep-lidars", o.keep_lidars, "NAME,...", "keep points and IMUs of these lidars only").commaSeparated();
  group.add("--keep-every", o.keep_every, "N", "keep every N-th scan, and all that is no scan").positive();
  group.add("--time-offset", o.time_offset, "LABEL=S", "add S seconds to the stamps of this label");
  group.add("--rebatch", o.rebatch, "HZ", "divide the points into scans at this rate, in Hz").between(0.1, 1000.0);
}

void addChangesOfPoints(OptionGroup& group, EditOptions& o)
{
  group.add("--crop-box", o.crop_box, "\"X0 Y0 Z0 X1 Y1 Z1\"", "remove points inside this box of the body frame, in m");
  group.add("--min-range", o.min_range, "M", "remove points nearer than this to their lidar, in m").notNegative();
  group.add("--max-range", o.max_range, "M", "remove points farther than this from their lidar, in m").positive();
  group.add("--voxel", o.voxel, "M", "keep the first point in each cube with this edge, in m").positive();
  group.add("--apply-extrinsics", o.apply_extrinsics, "FILE",
            "change the poses of the sensors: lines 'T_body_<name> ...', or a configuration (.ini)");
  group.add("--convert-clouds", o.convert_clouds, "CLASS", "convert clouds to CGenericPointsMap or CPointsMapXYZI");
  group.add("--deskew", o.deskew, "FILE|imu",
            "deskew clouds to their stamps by a trajectory (TUM, EuRoC or KITTI), or by the rawlog's IMU, which "
            "corrects the rotation only");
  group.add("--imu", o.imu, "LABEL", "for '--deskew imu': label of the IMU (default: imu), e.g. imu_left");
}

void addFiles(CLI::App& app, OptionGroup& group, EditOptions& o)
{
  group.add("--export-ply", o.export_ply, "DIR", "write a PLY file per cloud, in a folder per label");
  group.add("--export-pcd", o.export_pcd, "DIR", "write a PCD file per cloud");
  group.add("--export-kitti", o.export_kitti, "DIR", "write a KITTI scan (.bin) per cloud");
  group.add("--export-csv", o.export_csv, "DIR", "write IMU samples as EuRoC csv, and stamps and sizes of clouds");
  group.add("--export-tum", o.export_tum, "FILE", "write the poses in the rawlog as TUM");
  group.add("--to-simplemap", o.to_simplemap, "FILE", "write keyframes along --trajectory, as 'scanloom map' does");
  group.add("--to-octomap", o.to_octomap, "FILE",
            "write an occupancy map along --trajectory, as 'scanloom map' does: this .bt, and an .ot beside it");
  group.add("--to-mcap", o.to_mcap, "FILE",
            "write clouds, IMU and poses as an MCAP file, which Foxglove and ROS 2 play; poses of the rawlog, or of "
            "--trajectory");
  OptionGroup maps(app, "For --to-simplemap, --to-octomap and --to-mcap");
  maps.add("--trajectory", o.trajectory, "FILE",
           "poses of the body as TUM, EuRoC (.csv) or KITTI (times.txt beside it)");
  maps.add("--keyframe-distance", o.keyframe_distance, "M", "travel between keyframes, in m")
      .notNegative()
      .showDefault();
  maps.add("--octomap-preset", o.octomap_preset, "NAME", "preview, inventory or fine")
      .oneOf({"preview", "inventory", "fine"})
      .showDefault();
}

std::function<int()> addEditOptions(CLI::App& app)
{
  auto arguments = std::make_shared<EditArguments>();
  addOption(app, "-i,--input", arguments->input, "the rawlog to read").typeName("FILE");
  addOption(app, "-o,--output", arguments->output, "the rawlog to write").typeName("FILE");
  addOverwrite(app, arguments->overwrite);
  addConfiguration(app, arguments->configuration);
  addFlag(app, "-q,--quiet", arguments->quiet, "show no progress");
  addJson(app, arguments->json);
  OptionGroup group(app, "Operations");
  group.add("--info", arguments->info, "print what the rawlog holds, as 'scanloom info' does");
  group.add("--check", arguments->check, "look for faults in the rawlog; status 3 if it is not fit for SLAM");
  group
      .add("--from-pcap", arguments->from_pcap, "FILE,...",
           "make a rawlog of these captures, as 'scanloom record' does")
      .commaSeparated();
  group.add("--approach-a", arguments->approach_a,
            "with --from-pcap: merge whole turns, the paper's approach A, for comparison");
  addCut(app, arguments->options);
  addChoicesOfObservations(group, arguments->options);
  addChangesOfPoints(group, arguments->options);
  addFiles(app, group, arguments->options);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb editVerb()
{
  return {"edit", "one operation on a rawlog: cut, split, thin, convert, export, check", rigSchema("lidars"),
          &addEditOptions};
}
}  // namespace scanloom
