#include "World.h"

#include "LimitedRun.h"
#include "input/packets/CaptureReader.h"
#include "support/HandmadeBag.h"
#include "support/HandmadeMessages.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace scanloom
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* kScene =
    "[simulated_drive]\nduration = 3\nstandstill = 1\nspeed_up = 0.5\n"
    "[simulated_stand]\nstems_per_hectare = 400\n"
    "[simulated_lidars]\nlidar1_name = left\nlidar1_model = OS0-16\nlidar1_mode = 512x10\n"
    "lidar1_pose = 1.5 1.2 2.5 30 15 -25\nlidar2_name = right\nlidar2_pose = 1.5 -1.2 2.5 -30 15 25\n";

constexpr const char* kRig =
    "[lidars]\ndriver = CMultiLidarSensor\nprocess_rate = 100\npcap_input = drive/recording.pcap\n"
    "extrinsics = drive/extrinsics.txt\nimu_csv = drive/imu.csv\n"
    "lidar1_name = left\nlidar1_metadata = drive/left.json\n"
    "lidar2_name = right\nlidar2_metadata = drive/right.json\nscan_rate = 10\n"
    "[map_cells]\ncell_size = 0.5\n[output]\nmaps = false\n";

void write(const fs::path& file, const std::string& content) { std::ofstream(file, std::ios::binary) << content; }

std::uint32_t number(const std::string& bytes, std::size_t at)
{
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::string block(std::uint32_t type, std::string body)
{
  body.resize((body.size() + 3) / 4 * 4);
  const auto text = [](std::uint32_t value)
  { return std::string(reinterpret_cast<const char*>(&value), sizeof value); };
  const auto length = static_cast<std::uint32_t>(body.size() + 12);
  return text(type) + text(length) + body + text(length);
}

/** The same packets as pcapng; `pcap` has stamps in microseconds, as libpcap writes them, or nanoseconds. */
std::string pcapngOf(const std::string& pcap)
{
  constexpr std::size_t kFileHeader = 24, kPacketHeader = 16;
  const bool nanoseconds = number(pcap, 0) == 0xA1B23C4D;
  const auto text = [](auto value) { return std::string(reinterpret_cast<const char*>(&value), sizeof value); };
  std::string file =
      block(0x0A0D0D0A, text(std::uint32_t{0x1A2B3C4D}) + text(std::uint32_t{1}) + text(~std::uint64_t{0}));
  const std::string resolution =
      text(std::uint16_t{9}) + text(std::uint16_t{1}) + text(nanoseconds ? 9U : 6U) + text(0U);
  file += block(1, text(static_cast<std::uint32_t>(number(pcap, 20))) + text(0U) + resolution);
  for (std::size_t at = kFileHeader; at + kPacketHeader <= pcap.size();)
  {
    const std::uint32_t size = number(pcap, at + 8);
    const std::uint64_t stamp =
        number(pcap, at) * (nanoseconds ? 1'000'000'000ULL : 1'000'000ULL) + number(pcap, at + 4);
    file +=
        block(6, text(0U) + text(static_cast<std::uint32_t>(stamp >> 32)) + text(static_cast<std::uint32_t>(stamp)) +
                     text(size) + text(size) + pcap.substr(at + kPacketHeader, size));
    at += kPacketHeader + size;
  }
  return file;
}

enum class Encoding
{
  Ros1,
  Cdr
};

/** The drive's first packets as messages of Ouster's driver, with metadata, an IMU and poses. */
std::vector<HandmadeMessage> messagesOf(const fs::path& drive, Encoding encoding)
{
  constexpr int kPackets = 150;
  const std::string begin = encoding == Encoding::Cdr ? std::string("\0\1\0\0", 4) : "";
  const std::string packet_type =
      encoding == Encoding::Cdr ? "ouster_sensor_msgs/msg/PacketMsg" : "ouster_ros/PacketMsg";
  std::vector<HandmadeMessage> messages;
  CaptureReader capture(drive / "recording.pcap");
  Datagram datagram;
  for (int i = 0; i < kPackets && capture.next(datagram); ++i)
  {
    const std::string bytes(datagram.payload.begin(), datagram.payload.end());
    messages.push_back({fmt::format("/{}/packets", datagram.destination_port), packet_type,
                        static_cast<std::uint64_t>(nanoseconds(datagram.received)), begin + withLength(bytes)});
  }
  const std::uint64_t first = messages.front().received;
  for (const char* side : {"left", "right"})
  {
    const std::string text = contentOf(drive / (std::string(side) + ".json"));
    messages.push_back({fmt::format("/{}/metadata", side), "std_msgs/String", first, begin + withLength(text)});
  }
  if (encoding == Encoding::Cdr) return messages;
  for (std::uint64_t i = 0; i < 20; ++i)
    messages.push_back({"/imu", "sensor_msgs/Imu", first + 5'000'000 * i, imuMessage(first + 5'000'000 * i, "imu")});
  messages.push_back({"/tf_static", "tf2_msgs/TFMessage", first, transformMessage("base_link", "imu", 1)});
  messages.push_back({"/points", "sensor_msgs/PointCloud2", first,
                      cloudMessage(first, "left", {{1, 2, 3, 0, 0}, {2, 3, 4, 50'000'000, 1}})});
  return messages;
}

void writeBags(const fs::path& folder)
{
  const std::vector<HandmadeMessage> ros1 = messagesOf(folder / "drive", Encoding::Ros1),
                                     cdr = messagesOf(folder / "drive", Encoding::Cdr);
  for (const char* compression : {"none", "bz2", "lz4"})
    writeFile(folder / fmt::format("{}.bag", compression), ros1Of(ros1, compression));
  for (const char* compression : {"", "zstd", "lz4"})
    writeFile(folder / fmt::format("drive{}.mcap", compression), mcapOf(cdr, compression));
  writeDb3(folder / "drive.db3", cdr);
}

constexpr RunLimits kPatient{600, 600, 0};

class Maker
{
 public:
  Maker(fs::path scanloom, fs::path folder) : scanloom_(std::move(scanloom)), folder_(std::move(folder)) {}

  void run(const std::string& arguments) const
  {
    std::vector<std::string> command = wordsOf(arguments);
    command.insert(command.begin(), scanloom_.string());
    const RunResult result = limitedRun(command, folder_, kPatient);
    if (result.signal != 0 || (result.status != 0 && result.status != 3))
      throw std::runtime_error(fmt::format("scanloom {}: status {}: {}", arguments, result.status, result.errors));
  }
  void pack(const std::string& file) const { write(folder_ / (file + ".gz"), packed(contentOf(folder_ / file))); }
  void copy(const std::string& from, const std::string& to) const
  {
    fs::copy_file(folder_ / from, folder_ / to, fs::copy_options::overwrite_existing);
  }

 private:
  fs::path scanloom_, folder_;
};
}  // namespace

std::string Target::name() const
{
  std::string name = arguments;
  for (std::size_t at = 0; (at = name.find("{}", at)) != std::string::npos;) name.replace(at, 2, "<" + file + ">");
  return name;
}

std::vector<std::string> wordsOf(const std::string& command)
{
  std::vector<std::string> words{""};
  bool quoted = false;
  for (const char c : command)
    if (c == '\'')
      quoted = !quoted;
    else if (c == ' ' && !quoted)
      words.emplace_back();
    else
      words.back() += c;
  words.erase(std::remove(words.begin(), words.end(), ""), words.end());
  return words;
}

void makeWorld(const fs::path& scanloom, const fs::path& folder)
{
  fs::create_directories(folder / "out");
  write(folder / "scene.ini", kScene);
  write(folder / "rig.ini", kRig);
  const Maker maker(scanloom, folder);
  maker.run("simulate -c scene.ini --out-dir drive");
  write(folder / "drive.pcapng", pcapngOf(contentOf(folder / "drive/recording.pcap")));
  writeBags(folder);
  maker.copy("drive/recording.pcap", "drive.pcap");
  maker.pack("drive.pcap");
  maker.pack("drive.pcapng");
  maker.run("record -c rig.ini -o drive.rawlog");
  maker.run("edit -q -i drive.rawlog -o short.rawlog --to-index 300");
  maker.run("edit -q -i short.rawlog -o split.rawlog --split-lidars");
  maker.run("edit -q -i short.rawlog -o xyzi.rawlog --convert-clouds CPointsMapXYZI");
  maker.run("edit -q -i short.rawlog --export ply=ply");
  maker.run("edit -q -i short.rawlog --export pcd=pcd");
  maker.run("edit -q -i short.rawlog --export kitti=kitti");
  maker.copy("ply/lidar/000000.ply", "a.ply");
  maker.copy("pcd/lidar/000000.pcd", "a.pcd");
  maker.copy("kitti/lidar/velodyne/000000.bin", "a.bin");
  for (const char* cloud : {"a.ply", "a.pcd", "a.bin"}) maker.pack(cloud);
  maker.run(
      "map -i short.rawlog --trajectory drive/groundtruth.tum --preset preview -o map.bt -o map.ot "
      "-o map.simplemap");
  maker.copy("drive/groundtruth.tum", "true.tum");
  maker.run("map -i true.tum -o true.csv");
  maker.run("config --default slam");
}

namespace
{
/** Every verb that reads bags, on every container. */
std::vector<Target> targetsOfBags()
{
  std::vector<Target> targets;
  for (const char* bag :
       {"none.bag", "bz2.bag", "lz4.bag", "drive.mcap", "drivezstd.mcap", "drivelz4.mcap", "drive.db3"})
    for (const char* verb :
         {"info {} --json", "doctor {} --json",
          "record {} --set lidars.extrinsics=drive/extrinsics.txt -o out/a.rawlog",
          "slam {} --set lidars.extrinsics=drive/extrinsics.txt --set output.maps=false --out-dir out/slam",
          "evaluate --trajectory true.tum --reference {}", "config --for {}",
          "calibrate {} --set lidars.extrinsics=drive/extrinsics.txt --out-dir out/calibration",
          "view {} --png out/a.png"})
      targets.push_back({bag, Content::Binary, verb});
  return targets;
}

/** Recordings that others made, as far as they lie beside the project; ours have never seen what is in them. */
std::vector<Target> targetsOfOthersRecordings()
{
  constexpr std::uintmax_t kLargest = 1'200'000;  // bytes
  std::vector<Target> targets;
  const std::optional<fs::path> data = testData("");
  if (!data) return targets;
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(*data))
    if (entry.is_regular_file() && entry.file_size() < kLargest) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files)
  {
    const std::string extension = file.extension().string();
    if (extension != ".bag" && extension != ".mcap" && extension != ".db3" && extension != ".pcap" &&
        extension != ".rawlog")
      continue;
    for (const char* verb : {"info {} --json", "doctor {} --json", "record {} -o out/a.rawlog",
                             "slam {} --set output.maps=false --out-dir out/slam"})
      targets.push_back({file.string(), extension == ".rawlog" ? Content::Packed : Content::Binary, verb});
  }
  return targets;
}
}  // namespace

const std::vector<Target>& targets()
{
  using C = Content;
  static const std::string kMetadata = "--metadata drive/left.json --metadata drive/right.json";
  static const std::vector<Target> kOthers{
      {"drive.pcap", C::Binary, "info {} " + kMetadata},
      {"drive.pcap", C::Binary, "doctor {} " + kMetadata},
      {"drive.pcap", C::Binary, "record -c rig.ini --set lidars.pcap_input={} -o out/a.rawlog"},
      {"drive.pcap", C::Binary, "slam -c rig.ini --set lidars.pcap_input={} --out-dir out/slam"},
      {"drive.pcapng", C::Binary, "info {} " + kMetadata},
      {"drive.pcapng", C::Binary, "doctor {} " + kMetadata},
      {"drive.pcapng", C::Binary, "record -c rig.ini --set lidars.pcap_input={} -o out/a.rawlog"},
      {"drive.pcap.gz", C::Packed, "info {}"},
      {"drive.pcapng.gz", C::Packed, "info {}"},
      {"drive/left.json", C::Text, "info drive.pcap --metadata {}"},
      {"drive/left.json", C::Text, "doctor drive.pcap --metadata {} --metadata drive/right.json"},
      {"drive/left.json", C::Text, "record -c rig.ini --set lidars.lidar1_metadata={} -o out/a.rawlog"},
      {"drive/left.json", C::Binary, "slam -c rig.ini --set lidars.lidar1_metadata={} --out-dir out/slam"},
      {"drive/imu.csv", C::Text, "record -c rig.ini --set lidars.imu_csv={} -o out/a.rawlog"},
      {"drive/imu.csv", C::Text, "doctor -c rig.ini --set lidars.imu_csv={}"},
      {"drive/imu.csv", C::Text, "slam -c rig.ini --set lidars.imu_csv={} --out-dir out/slam"},
      {"drive/extrinsics.txt", C::Text, "doctor -c rig.ini --set lidars.extrinsics={}"},
      {"drive/extrinsics.txt", C::Text, "slam -c rig.ini --set lidars.extrinsics={} --out-dir out/slam"},
      {"drive/extrinsics.txt", C::Text, "edit -q -i short.rawlog -o out/a.rawlog --apply-extrinsics {}"},
      {"rig.ini", C::Text, "record -c {} -o out/a.rawlog"},
      {"rig.ini", C::Text, "slam -c {} --out-dir out/slam"},
      {"drive/configuration.ini", C::Text, "simulate -c {} --out-dir out/drive --dry-run"},
      {"drive.rawlog", C::Packed, "info {} --json"},
      {"drive.rawlog", C::Packed, "doctor {} --json"},
      {"drive.rawlog", C::Packed, "slam -c rig.ini {} --out-dir out/slam"},
      {"short.rawlog", C::Packed, "edit -q -i {} -o out/a.rawlog --split-lidars"},
      {"split.rawlog", C::Packed, "edit -q -i {} -o out/a.rawlog --merge-lidars"},
      {"split.rawlog", C::Packed, "doctor {}"},
      {"short.rawlog", C::Packed, "edit -q -i {} -o out/a.rawlog --keep-lidars left"},
      {"short.rawlog", C::Packed, "edit -q -i {} -o out/a.rawlog --rebatch 25"},
      {"short.rawlog", C::Packed, "edit -q -i {} -o out/a.rawlog --voxel 0.5"},
      {"short.rawlog", C::Packed, "edit -q -i {} -o out/a.rawlog --crop-box '-2 -2 -2 2 2 2'"},
      {"short.rawlog", C::Packed, "edit -q -i {} -o out/a.rawlog --ranges '0 20'"},
      {"short.rawlog", C::Packed, "edit -q -i {} -o out/a.rawlog --apply-extrinsics drive/extrinsics.txt"},
      {"short.rawlog", C::Packed, "edit -q -i {} -o out/a.rawlog --time-offset imu=0.01"},
      {"short.rawlog", C::Packed, "edit -q -i {} -o out/a.rawlog --deskew imu"},
      {"short.rawlog", C::Packed, "edit -q -i {} -o out/a.rawlog --deskew true.tum"},
      {"short.rawlog", C::Packed, "edit -q -i {} -o out/a.rawlog --convert-clouds CPointsMapXYZI"},
      {"xyzi.rawlog", C::Packed, "edit -q -i {} -o out/a.rawlog --convert-clouds CGenericPointsMap"},
      {"short.rawlog", C::Packed, "edit -q -i {} --export ply=out/ply"},
      {"short.rawlog", C::Packed, "edit -q -i {} --export pcd=out/pcd"},
      {"short.rawlog", C::Packed, "edit -q -i {} --export csv=out/csv"},
      {"short.rawlog", C::Packed, "map -i {} --trajectory true.tum --preset preview -o out/a.bt -o out/a.simplemap"},
      {"xyzi.rawlog", C::Packed, "view {} --png out/a.png"},
      {"a.ply", C::Binary, "register {} a.pcd"},
      {"a.pcd", C::Binary, "register a.ply {}"},
      {"a.bin", C::Binary, "register a.ply {}"},
      {"a.ply.gz", C::Packed, "register {} a.ply"},
      {"a.pcd.gz", C::Packed, "register {} a.ply"},
      {"a.bin.gz", C::Packed, "register {} a.ply"},
      {"a.ply", C::Binary, "view {} --png out/a.png"},
      {"true.tum", C::Text, "evaluate --trajectory {} --reference drive/groundtruth.tum"},
      {"true.csv", C::Text, "evaluate --trajectory {} --reference drive/groundtruth.tum --json"},
      {"drive/total_station.csv", C::Text, "evaluate --trajectory true.tum --reference {}"},
      {"true.tum", C::Text, "edit -q -i short.rawlog -o out/a.rawlog --deskew {}"},
      {"true.tum", C::Text, "map -i short.rawlog --trajectory {} --preset preview -o out/a.bt"},
      {"true.tum", C::Text, "map -i {} -o out/a.csv"},
      {"short.rawlog", C::Packed, "edit -q -i {} --to-mcap out/a.mcap"},
      {"drive.pcap", C::Binary, "config --for {}"},
      {"drive.pcap", C::Binary, "calibrate -c rig.ini --set lidars.pcap_input={} --out-dir out/calibration"},
      {"map.bt", C::Binary, "map -i {} -o out/a.ply"},
      {"map.ot", C::Binary, "map -i {} -o out/a.bt -o out/a.ply"},
      {"map.ot", C::Binary, "view {} --png out/a.png"},
      {"map.simplemap", C::Packed, "map -i {} --preset preview -o out/a.bt -o out/a.ply"},
      {"map.simplemap", C::Packed, "view {} --png out/a.png"},
  };
  static const std::vector<Target> kTargets = [&]
  {
    std::vector<Target> all = kOthers;
    for (const std::vector<Target>& more : {targetsOfBags(), targetsOfOthersRecordings()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return kTargets;
}
}  // namespace scanloom
