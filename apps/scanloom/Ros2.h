/** --ros2: sensors that publish on ROS 2 as input, and results on topics of our own (doc/ros2.md). */
#pragma once
#include "Arguments.h"
#include "Recording.h"
#include "base/core/ScratchFolder.h"
#include "input/rig/Rig.h"
#include "input/ros2/Ros2Node.h"
#include "run/topics/RosTopics.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace scanloom
{
struct Ros2Arguments
{
  std::string name_space;  // of what is published; empty: --ros2 was not given

  bool given() const { return !name_space.empty(); }
};

/** Adds --ros2 [NAMESPACE], for verbs that publish. */
void addRos2(CLI::App&, Ros2Arguments&);

/** Adds the flag --ros2, for verbs that only listen. */
void addRos2Input(CLI::App&, bool&);

/** Topics that were heard for a while, in a file of their own until the end of its life: a recording like others. */
class HeardTopics
{
 public:
  /** Says on stderr that it listens. Throws std::runtime_error if no topic of a sensor was heard. */
  HeardTopics(Ros2Node&, Duration);

  std::filesystem::path file() const { return folder_.path() / "topics.mcap"; }

 private:
  ScratchFolder folder_;
};

/** For verbs that only listen: what was heard for this long replaces the recording, if `wanted`. */
std::unique_ptr<HeardTopics> hearInstead(bool wanted, Duration, RecordingArguments&);

/** A verb among the nodes of ROS 2. */
class Ros2
{
 public:
  /**
   * Where no recording is given and the configuration names topics, or no lidars at all, the lidars are heard on
   * topics: the first five seconds describe them, as a bag would. Throws UsageError for a wrong namespace, and what
   * openRos2Node() and HeardTopics throw.
   */
  Ros2(const Ros2Arguments&, const std::string& verb, const ConfigurationArguments&, const RecordingArguments&);

  /** Null if the lidars are not heard on topics. */
  const HeardTopics* heard() const { return heard_.get(); }

  /** The rig that this recording describes, live; any other rig as it is. */
  Rig live(Rig) const;

  std::unique_ptr<RosTopics> publish(bool localised) const;

 private:
  std::string name_space_;
  std::shared_ptr<Ros2Node> node_;
  std::unique_ptr<HeardTopics> heard_;
};

/** What the input gives is published on its way; that of a recording when the sensors' time has passed. */
std::unique_ptr<SensorInput> published(SensorInput&, RosTopics&, bool live);

/** The recording that was given, or that was heard; empty if neither. Throws as filesOf() does. */
RecordingFiles filesOf(const RecordingArguments&, const Ros2*);

/** Null if --ros2 was not given. */
std::unique_ptr<Ros2> openRos2(const Ros2Arguments&, const std::string& verb, const ConfigurationArguments&,
                               const RecordingArguments&);
}  // namespace scanloom
