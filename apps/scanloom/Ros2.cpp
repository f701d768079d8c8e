#include "Ros2.h"

#include "base/core/ConfigError.h"
#include "base/core/Interruption.h"
#include "base/core/Text.h"
#include "input/rig/RigOptions.h"
#include "input/ros2/TopicRecording.h"

#include <fmt/format.h>

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr const char* kDefaultNamespace = "/scanloom";
constexpr Duration kDescribed = 5s;  // several messages of each topic, and metadata that come once in a while

/** Whether a rig of this configuration is heard on topics: it names some, or no lidar at all. */
bool isOnTopics(const ConfigurationArguments& arguments)
{
  Configuration configuration = Configuration::fromFiles(arguments.files);
  for (const std::string& assignment : arguments.assignments) configuration.set(assignment);
  if (!hasRigSection(configuration)) return true;
  const std::string section = rigSection(configuration);
  const std::vector<std::string> keys = configuration.keys(section);
  const auto has_value = [&](const std::string& key) { return !configuration.text(section, key).empty(); };
  if (std::find(keys.begin(), keys.end(), "pcap_input") != keys.end() && has_value("pcap_input")) return false;
  return std::any_of(keys.begin(), keys.end(),
                     [&](const std::string& key) { return endsWith(key, "_topic") && has_value(key); });
}
}  // namespace

void addRos2(CLI::App& app, Ros2Arguments& arguments)
{
  addOption(app, "--ros2", arguments.name_space,
            fmt::format("publish scans and results on topics of ROS 2 below this namespace [{}]; without a RECORDING "
                        "lidars that are configured by topics, or not at all, are heard on theirs",
                        kDefaultNamespace))
      .optionalValue(kDefaultNamespace)
      .typeName("NAMESPACE");
}

void addRos2Input(CLI::App& app, bool& wanted)
{
  addFlag(app, "--ros2", wanted, "instead of a RECORDING: the topics of ROS 2, heard for a while");
}

HeardTopics::HeardTopics(Ros2Node& node, Duration duration)
  : folder_(std::filesystem::temp_directory_path(), "scanloom_topics")
{
  catchInterruption();
  fmt::print(stderr, "listens to the topics of ROS 2 for {:g} s\n", seconds(duration));
  if (recordTopics(node, duration, file(), [] { return !interrupted(); }) > 0) return;
  const std::size_t others = node.publications().size();
  throw std::runtime_error(
      others == 0
          ? "no topic of ROS 2 was heard: check that the drivers run, that ROS_DOMAIN_ID is theirs, and, where they "
            "run on another computer, that neither ROS_LOCALHOST_ONLY nor a firewall is in between"
          : fmt::format("{} topics of ROS 2 were discovered, but none with packets or clouds of lidars gave a message",
                        others));
}

std::unique_ptr<HeardTopics> hearInstead(bool wanted, Duration duration, RecordingArguments& recording)
{
  if (!wanted) return nullptr;
  if (recording.given()) throw UsageError("--ros2 is instead of a RECORDING: give one of them");
  const std::unique_ptr<Ros2Node> node = openRos2Node(ros2NetworkOfEnvironment(), "/", "scanloom_listener");
  auto heard = std::make_unique<HeardTopics>(*node, duration);
  recording.paths = {heard->file()};
  return heard;
}

Ros2::Ros2(const Ros2Arguments& arguments, const std::string& verb, const ConfigurationArguments& configuration,
           const RecordingArguments& recording)
  : name_space_(beginsWith(arguments.name_space, "/") ? arguments.name_space : "/" + arguments.name_space)
{
  if (!isRosName(name_space_))
    throw UsageError(
        fmt::format("--ros2 {}: is no namespace of ROS 2 (letters, digits, _ and /); without one write "
                    "--ros2 last, or --ros2={}",
                    arguments.name_space, kDefaultNamespace));
  node_ = openRos2Node(ros2NetworkOfEnvironment(), name_space_, verb);
  if (!recording.given() && isOnTopics(configuration)) heard_ = std::make_unique<HeardTopics>(*node_, kDescribed);
}

Rig Ros2::live(Rig rig) const { return heard_ ? heardOn(node_, std::move(rig)) : std::move(rig); }

std::unique_ptr<RosTopics> Ros2::publish(bool localised) const
{
  return std::make_unique<RosTopics>(node_, name_space_, localised);
}

std::unique_ptr<SensorInput> published(SensorInput& input, RosTopics& topics, bool live)
{
  using Pace = PublishedInput::Pace;
  return std::make_unique<PublishedInput>(input, topics, live ? Pace::OfInput : Pace::OfSensors);
}

RecordingFiles filesOf(const RecordingArguments& arguments, const Ros2* ros2)
{
  if (ros2 && ros2->heard()) return filesOf(RecordingArguments{{ros2->heard()->file()}, {}});
  return arguments.given() ? filesOf(arguments, Clouds::Taken) : RecordingFiles{};
}

std::unique_ptr<Ros2> openRos2(const Ros2Arguments& arguments, const std::string& verb,
                               const ConfigurationArguments& configuration, const RecordingArguments& recording)
{
  if (!arguments.given()) return nullptr;
  return std::make_unique<Ros2>(arguments, verb, configuration, recording);
}
}  // namespace scanloom
