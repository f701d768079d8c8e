/**
 * Any bytes as a packet of every profile at once, so that each run is one execution for each of them: what kind()
 * accepts is decoded without exceptions, by every kernel to the same bits; anything else throws at most
 * std::out_of_range.
 * fuzz options: -max_len=900
 */
#include <stdexcept>

#include "../input/lidar/simpleMetadata.h"
#include "input/lidar/OusterDecoder.h"
#include "input/lidar/internal/OusterLayout.h"
#include "require.h"

using namespace scanloom;

namespace
{
/** What is corrected before decoding; otherwise nearly all bytes would be refused at once. */
enum Mend : std::uint8_t
{
  kSize = 1,
  kHeader = 2,  // type and serial number
  kChecksum = 4,
  kImu = 8,  // the packet is meant as one of the IMU's
};

constexpr int kChannels = 19;  // more than the widest kernel takes at a time, and some left over

/** Per profile: a decoder for each kernel that this machine runs. */
std::vector<std::vector<OusterDecoder>> everyDecoder()
{
  std::vector<std::vector<OusterDecoder>> decoders;
  for (const OusterProfile& profile : kOusterProfiles)
  {
    OusterMetadata m = simpleMetadata(std::string(profile.name), kChannels, 2);
    m.lidar_mode = "16x10";  // small turns
    m.columns_per_frame = 16;
    m.last_column = 15;
    m.imu_profile = decoders.size() % 2 ? OusterImuProfile::Legacy : OusterImuProfile::Accel32Gyro32Nmea;
    m.imu_measurements_per_packet = 2;
    decoders.emplace_back();
    for (const Kernel kernel : runnableKernels()) decoders.back().emplace_back(m, Rigid::identity(), kernel);
  }
  return decoders;
}

void put(std::vector<std::uint8_t>& packet, ByteField field, std::uint64_t value)
{
  if (field.offset + field.count <= packet.size()) std::memcpy(packet.data() + field.offset, &value, field.count);
}

void mend(std::vector<std::uint8_t>& packet, std::uint8_t what, const OusterLayout& layout)
{
  const bool imu = what & kImu;
  const OusterHeader header = imu ? layout.imu_header : layout.lidar_header;
  if (what & kSize) packet.resize(imu ? layout.imuPacketBytes() : layout.lidarPacketBytes());
  if (header == OusterHeader::None) return;
  if (what & kHeader)
  {
    put(packet, headerFields(header).type, imu ? kOusterImuType : kOusterLidarType);
    put(packet, headerFields(header).serial, 0);  // says nothing of its sensor
  }
  if ((what & kChecksum) && OusterLayout::hasCrc(header) && packet.size() >= kOusterCrcBytes)
  {
    const std::size_t end = packet.size() - kOusterCrcBytes;
    store(packet, end, crc64(Bytes(packet).slice(0, end)));
  }
}

void decodeImu(const OusterDecoder& decoder, Bytes packet)
{
  decoder.header(packet);
  for (const ImuSample& sample : decoder.imuSamples(packet))
    require(sample.accel.allFinite() && sample.gyro.allFinite());
}

PointCloud pointsOf(const OusterDecoder& decoder, Bytes packet)
{
  std::vector<MeasurementBlock> blocks;
  PointCloud points;
  decoder.header(packet);
  decoder.readBlocks(packet, blocks);
  require(blocks.size() == 2);
  for (const MeasurementBlock& block : blocks)
  {
    const std::size_t before = points.size();
    decoder.appendPoints(packet, block.index, 0, 0, points);
    require(block.valid || points.size() == before);
    require(!block.valid || (block.measurement_id < 16 && block.stamp >= Timestamp{}));
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    require(points.range[i] > 0 && points.ring[i] < kChannels && points.position(i).allFinite());
  return points;
}

void decodeLidar(const OusterDecoder& decoder, Bytes packet) { pointsOf(decoder, packet); }

template <typename Values>
bool sameBits(const Values& a, const Values& b)
{
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

bool sameBits(const PointCloud& a, const PointCloud& b)
{
  return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z) && sameBits(a.intensity, b.intensity) &&
         sameBits(a.ring, b.ring) && sameBits(a.column, b.column) && sameBits(a.range, b.range) &&
         sameBits(a.signal, b.signal) && sameBits(a.near_ir, b.near_ir);
}

void refuse(void (*decode)(const OusterDecoder&, Bytes), const OusterDecoder& decoder, Bytes packet)
{
  mayThrow<std::out_of_range>([&] { decode(decoder, packet); });
}
}  // namespace

/** The first byte tells what is corrected, the second which profile is tested more closely. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const auto decoders = everyDecoder();
  static std::vector<std::uint8_t> mended;
  if (size < 2) return 0;
  for (const auto& kernels : decoders)
  {
    const bool chosen = &kernels == &decoders[data[1] % decoders.size()];
    const OusterDecoder& decoder = kernels.back();
    mended.assign(data + 2, data + size);
    mend(mended, data[0], decoder.layout());
    const std::vector<std::uint8_t> packet(mended);  // not a byte of memory behind its end
    switch (decoder.kind(packet))
    {
      case PacketKind::Lidar:
      {
        const PointCloud points = pointsOf(decoder, packet);
        if (!chosen) break;
        for (const OusterDecoder& other : kernels) require(sameBits(points, pointsOf(other, packet)));
        break;
      }
      case PacketKind::Imu:
        decodeImu(decoder, packet);
        break;
      default:
        if (!chosen) break;
        refuse(&decodeLidar, decoder, packet);
        refuse(&decodeImu, decoder, packet);
    }
  }
  return 0;
}
