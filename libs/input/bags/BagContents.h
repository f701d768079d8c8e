/** What bags hold, and their IMU samples and poses. */
#pragma once
#include "base/core/oneOfEachStamp.h"
#include "input/bags/internal/FrameTree.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
using BagPaths = std::vector<std::filesystem::path>;

struct TopicContents
{
  std::string name, type;
  std::uint64_t messages = 0;
  Timestamp first, last;     // receive times; the same if there are fewer than two messages
  std::string frame;         // of the first message with packets, IMU samples or a cloud that names one
  std::string note;          // of clouds: what their points' time is, or why they have none
  bool one_instant = false;  // of clouds: all points of one have the same time
};

struct BagContents
{
  std::vector<TopicContents> topics;            // by name
  std::map<std::string, std::string> metadata;  // by topic: strings that describe a lidar; of clouds what they show
  FrameTree frames;                             // by tf_static
  std::vector<std::string> warnings;            // where a file is damaged
  std::uint64_t unreadable = 0;                 // messages of the types that are looked into

  std::vector<TopicContents> ofType(bool (*isWanted)(const std::string& type)) const;
};

/** Reads the first `longest` of the bags' receive times. Files that are no bags are passed over. Throws what
 * BagReader::open throws. */
BagContents contentsOf(const BagPaths&, Duration longest = Duration::max());

/** A table for a person. */
std::string toText(const BagContents&);

/** The same for a program; stamps in ns. */
std::string toJson(const BagContents&);

/** The same text of one topic. Throws std::invalid_argument, naming the topics there are, if it has none. */
std::string metadataIn(const BagPaths&, const std::string& topic);

/** In order of stamps. Throws std::invalid_argument, naming the topics with IMU samples, if this is none. */
ImuOfEachStamp readBagImu(const BagPaths&, const std::string& topic);

/** Of one message; none if it cannot be read. */
std::optional<ImuSample> imuSampleIn(const BagTopic&, Bytes message);

struct BagPoses
{
  Trajectory poses;
  bool have_rotations = true;  // PointStamped has none
  std::size_t unreadable = 0;  // messages that cannot be read
};

/**
 * In order of stamps, of each stamp the first. Without a topic those of the only one with poses. Throws
 * std::invalid_argument, naming the topics with poses, if this is none, or if there are several to choose from.
 */
BagPoses readBagPoses(const BagPaths&, const std::string& topic);

bool isImuType(const std::string& type);
}  // namespace scanloom
