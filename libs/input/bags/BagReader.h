/** Recordings of ROS 1 and ROS 2, and rawlogs of packets as if they were: topics and their messages. */
#pragma once
#include "input/bags/internal/MessageReader.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
struct BagTopic
{
  std::string name;
  std::string type;  // as ROS 1 writes it: "sensor_msgs/Imu"
  Serialisation serialisation = Serialisation::Unknown;
};

struct BagMessage
{
  std::size_t topic = 0;  // place in topics()
  Timestamp received;     // by the recording program
  Bytes data;             // valid until the next message is read
};

/**
 * A bag, whatever its container: SQLite (.db3), MCAP, ROS 1 (.bag), a rawlog of packets. Damaged and cut files are read
 * up to the damage, which is reported once. At no time more than one message (SQLite, rawlog) or one chunk (the others)
 * of a file is in memory.
 */
class BagReader
{
 public:
  virtual ~BagReader() = default;

  /**
   * A file (plain, or in gzip or zstd), or a folder with the files of one bag. Throws std::runtime_error with the
   * file's name if it can't be read or is no bag.
   */
  static std::unique_ptr<BagReader> open(const std::filesystem::path& file_or_folder);

  /** Grows while a file is read whose index leaves topics out. */
  virtual const std::vector<BagTopic>& topics() const = 0;

  /**
   * Replaces `message` by the next one; false at the end. In the order of receive times: within a SQLite file, within a
   * chunk of the others, and among the files of a folder; chunks come in the order of their file.
   */
  virtual bool next(BagMessage& message) = 0;

  /** Where and why a file was not read to its end, since the last call. */
  virtual std::vector<std::string> takeWarnings() = 0;

  /** Share of the bytes that were read, 0 to 1. */
  virtual double progress() const = 0;
};

/** Whether it is a bag by what it begins with, gzip and zstd unpacked, or a folder that holds one. */
bool isBag(const std::filesystem::path& file_or_folder);

/** Whether it is an MCAP of our McapWriter: its header names scanloom as the library that wrote it. */
bool isExportedBag(const std::filesystem::path&);

/** The topics of all bags among the files, of each file in its order. Throws what BagReader::open throws. */
std::vector<BagTopic> topicsOf(const std::vector<std::filesystem::path>& recordings);

/** A receive time as a container writes it, in ns; one that no clock can show (before 1970, after 2115) is the nearest
 * of these. */
Timestamp bagStamp(std::int64_t);
Timestamp bagStamp(std::uint64_t);

/** "sensor_msgs/msg/Imu" as "sensor_msgs/Imu". */
std::string typeNameOf(const std::string& type);

/** A topic as its container declares it. Its names become printable: they end in messages, JSON and configurations. */
BagTopic declaredTopic(const std::string& name, const std::string& type, Serialisation);
}  // namespace scanloom
