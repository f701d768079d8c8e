/** Packets simulated for real sensors' metadata beside the packets that those sensors sent: every field by its meaning.
 */
#include "base/core/Bytes.h"
#include "input/lidar/internal/OusterLayout.h"
#include "input/packets/CaptureReader.h"
#include "lab/simulation/internal/ScenePackets.h"
#include "support/TestData.h"

#include <gtest/gtest.h>

#include <ostream>
#include <set>

namespace scanloom::real_captures_unittest
{
namespace
{
/** Read by offsets of the maker's manual, not by our decoder. */
struct Semantics
{
  std::set<std::size_t> lidar_bytes, imu_bytes;
  std::set<unsigned> packet_types;                 // of the header
  std::set<bool> serial_is_the_metadatas;          // as far as the header has one
  std::set<bool> crc_is_right;                     // as far as there is one
  std::set<unsigned> status_of_columns;            // without those outside of a window
  bool ids_follow_each_other = true;               // within a packet
  bool packets_begin_at_multiples = true;          // of the columns per packet
  bool frame_changes_where_ids_begin_anew = true;  // and nowhere else
  bool stamps_have_the_rate_of_the_mode = true;    // within 5 %, over a packet
  bool imu_stamps_are_ordered = true;
  bool imu_is_in_g = true;

  bool operator==(const Semantics& o) const { return text() == o.text(); }
  std::string text() const
  {
    std::string text;
    const auto add = [&](const char* name, const auto& values)
    {
      text += std::string(name) + ":";
      for (const auto value : values) text += " " + std::to_string(value);
      text += "\n";
    };
    add("lidar bytes", lidar_bytes);
    add("imu bytes", imu_bytes);
    add("types", packet_types);
    add("serial right", serial_is_the_metadatas);
    add("crc right", crc_is_right);
    add("status", status_of_columns);
    add("flags", std::vector<int>{ids_follow_each_other, packets_begin_at_multiples, frame_changes_where_ids_begin_anew,
                                  stamps_have_the_rate_of_the_mode, imu_stamps_are_ordered, imu_is_in_g});
    return text;
  }
};
void PrintTo(const Semantics& s, std::ostream* out) { *out << s.text(); }

class Reader
{
 public:
  explicit Reader(const OusterMetadata& metadata) : metadata_(metadata), layout_(layoutOf(metadata)) {}

  void read(const Datagram& datagram)
  {
    const Bytes packet(datagram.payload);
    if (datagram.payload.size() == layout_.imuPacketBytes() && layout_.imuPacketBytes() > 0)
      readImu(packet);
    else if (datagram.payload.size() == layout_.lidarPacketBytes())
      readLidar(packet);
  }

  Semantics semantics;

 private:
  void readLidar(Bytes packet)
  {
    semantics.lidar_bytes.insert(packet.size());
    if (!layout_.isLegacy())
    {
      const bool fusa = layout_.lidar_header == OusterHeader::Fusa;
      semantics.packet_types.insert(load<std::uint8_t>(packet, 0));
      if (!fusa)
      {
        const std::uint64_t serial = loadUnsigned(packet, 7, 5);
        semantics.serial_is_the_metadatas.insert(serial == serialNumber(metadata_));
        const std::uint64_t crc = load<std::uint64_t>(packet, packet.size() - 8);
        if (crc != 0) semantics.crc_is_right.insert(crc == crc64(packet.slice(0, packet.size() - 8)));
      }
    }
    const bool is_fusa = layout_.lidar_header == OusterHeader::Fusa;
    const auto frame_of_header =
        layout_.isLegacy() ? 0u
                           : static_cast<unsigned>(is_fusa ? loadUnsigned(packet, 4, 4) : loadUnsigned(packet, 2, 2));
    for (std::size_t i = 0; i < layout_.columns; ++i) readColumn(packet, i, frame_of_header);
  }

  void readColumn(Bytes packet, std::size_t i, unsigned frame)
  {
    const std::size_t at = layout_.columnOffset(i);
    const auto stamp = static_cast<double>(load<std::uint64_t>(packet, at));
    const unsigned id = load<std::uint16_t>(packet, at + 8);
    if (layout_.isLegacy()) frame = load<std::uint16_t>(packet, at + 10);
    const bool is_inside =
        metadata_.first_column <= metadata_.last_column
            ? static_cast<int>(id) >= metadata_.first_column && static_cast<int>(id) <= metadata_.last_column
            : static_cast<int>(id) >= metadata_.first_column || static_cast<int>(id) <= metadata_.last_column;
    const unsigned status = layout_.isLegacy()
                                ? load<std::uint32_t>(packet, at + layout_.columnBytes() - 4) == 0xFFFFFFFF
                                : load<std::uint16_t>(packet, at + 10);
    if (is_inside) semantics.status_of_columns.insert(status);
    if (i == 0) semantics.packets_begin_at_multiples &= id % layout_.columns == 0;
    if (i == 0) first_stamp_ = stamp, was_inside_ = true;
    was_inside_ &= is_inside;
    if (i > 0) semantics.ids_follow_each_other &= id == last_id_ + 1;
    if (i + 1 == layout_.columns && was_inside_)
    {
      const double nominal = 1e9 / (metadata_.frame_rate * metadata_.columns_per_frame) * static_cast<double>(i);
      semantics.stamps_have_the_rate_of_the_mode &= std::abs(stamp - first_stamp_ - nominal) < 0.05 * nominal;
    }
    if (seen_) semantics.frame_changes_where_ids_begin_anew &= (frame != last_frame_) == (id < last_id_);
    seen_ = true;
    last_id_ = id;
    last_frame_ = frame;
  }

  void readImu(Bytes packet)
  {
    semantics.imu_bytes.insert(packet.size());
    if (layout_.imu_profile != OusterImuProfile::Legacy) return;
    const auto accel = load<std::uint64_t>(packet, 8), gyro = load<std::uint64_t>(packet, 16);
    semantics.imu_stamps_are_ordered &= accel <= gyro + 20'000'000 && gyro <= accel + 20'000'000;
    const double x = load<float>(packet, 24), y = load<float>(packet, 28), z = load<float>(packet, 32);
    semantics.imu_is_in_g &= std::abs(std::sqrt(x * x + y * y + z * z) - 1) < 0.5;
  }

  const OusterMetadata& metadata_;
  OusterLayout layout_;
  bool seen_ = false, was_inside_ = false;
  unsigned last_id_ = 0, last_frame_ = 0;
  double first_stamp_ = 0;
};

Semantics ofCapture(const std::filesystem::path& capture, const OusterMetadata& metadata)
{
  Reader reader(metadata);
  CaptureReader packets(capture);
  for (Datagram datagram; packets.next(datagram);) reader.read(datagram);
  return reader.semantics;
}

Semantics ofSimulation(const std::filesystem::path& metadata)
{
  SimulationSettings settings;
  settings.drive.route = "work";
  settings.drive.duration = 0.35;
  settings.drive.speed_up = 1;
  settings.forest.stand.stems_per_hectare = 0;
  settings.lidars.resize(1);
  settings.lidars[0] = SimulatedLidarOptions{};
  settings.lidars[0].name = "real";
  settings.lidars[0].metadata = metadata.string();
  settings.lidars[0].port = 7502;
  const Scene scene = makeScene(settings, 1);
  Reader reader(scene.lidars[0].metadata());
  ScenePackets packets(scene);
  for (Datagram datagram; packets.next(datagram);) reader.read(datagram);
  return reader.semantics;
}

struct CaptureCase
{
  const char* capture;
  const char* metadata;
};
void PrintTo(const CaptureCase& row, std::ostream* out) { *out << row.capture; }

using SimulatedPackets = testing::TestWithParam<CaptureCase>;

TEST_P(SimulatedPackets, meanWhatTheSensorsOwnPacketsMean)
{
  SCANLOOM_NEEDS_DATA(folder, "ouster/ouster-lidar+ouster-sdk/tests/pcaps");
  const std::filesystem::path metadata = folder / GetParam().metadata;
  Semantics real = ofCapture(folder / GetParam().capture, loadOusterMetadata(metadata.string()));
  Semantics simulated = ofSimulation(metadata);
  ASSERT_FALSE(real.lidar_bytes.empty());
  if (real.imu_bytes.empty()) simulated.imu_bytes.clear();  // none was captured
  if (real.crc_is_right != std::set<bool>{true})            // firmware before 2.4 has other bytes there, or none
    real.crc_is_right.clear(), simulated.crc_is_right.clear();
  EXPECT_EQ(simulated, real);
}

INSTANTIATE_TEST_SUITE_P(
    , SimulatedPackets,
    testing::Values(CaptureCase{"OS-0-32-U1_v2.2.0_1024x10.pcap", "OS-0-32-U1_v2.2.0_1024x10.json"},
                    CaptureCase{"OS-1-32-G_v2.1.1_1024x10.pcap", "OS-1-32-G_v2.1.1_1024x10.json"},
                    CaptureCase{"OS-2-128-U1_v2.3.0_1024x10.pcap", "OS-2-128-U1_v2.3.0_1024x10.json"},
                    CaptureCase{"OS-1-128_v2.3.0_1024x10_lb_n3.pcap", "OS-1-128_v2.3.0_1024x10.json"},
                    CaptureCase{"OS-1-128_767798045_1024x10_20230712_120049.pcap",
                                "OS-1-128_767798045_1024x10_20230712_120049.json"},
                    CaptureCase{"crc_test.pcap", "crc_test.json"},
                    CaptureCase{"windowed_frame1.pcap", "windowed_frame1_0.json"},
                    CaptureCase{"shot_limiting_test.pcap", "shot_limiting_test.json"}));
}  // namespace
}  // namespace scanloom::real_captures_unittest
