/**
 * Writes seeds for the fuzz targets from recordings: a folder per target below OUT. Each is cut to the size and led by
 * the first bytes that its target expects. scanloom_fuzz_corpus RECORDINGS INIS OUT
 */
#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>

#include "../input/lidar/simpleMetadata.h"
#include "input/lidar/MetadataKeys.h"
#include "input/lidar/OusterDecoder.h"
#include "input/lidar/internal/Hesai.h"
#include "input/lidar/internal/Robosense.h"
#include "input/lidar/internal/Velodyne.h"
#include "input/packets/CaptureReader.h"

namespace fs = std::filesystem;
using namespace scanloom;

namespace
{
using Seed = std::vector<std::uint8_t>;

constexpr std::uint8_t kAllMended = 7;  // lidar_ouster_packet
constexpr std::size_t kFuzzChannels = 19;
constexpr std::size_t kPacketsPerCapture = 4;

class Corpus
{
 public:
  explicit Corpus(fs::path folder) : folder_(std::move(folder)) {}

  void add(const std::string& target, const Seed& seed)
  {
    fs::create_directories(folder_ / target);
    std::ofstream file(folder_ / target / ("recorded_" + std::to_string(count_[target]++)), std::ios::binary);
    file.write(reinterpret_cast<const char*>(seed.data()), static_cast<std::streamsize>(seed.size()));
  }

  const std::map<std::string, int>& counts() const { return count_; }

 private:
  fs::path folder_;
  std::map<std::string, int> count_;
};

Seed bytesOf(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Seed led(std::initializer_list<std::uint8_t> first, Bytes rest, std::size_t most)
{
  Seed seed = first;
  seed.insert(seed.end(), rest.begin(), rest.begin() + std::min(rest.size(), most - seed.size()));
  return seed;
}

/** The packet as the target's sensor of few channels and two columns would send it. */
Seed cutDown(const OusterDecoder& decoder, Bytes packet)
{
  const OusterLayout& layout = decoder.layout();
  Seed seed(packet.begin(), packet.begin() + layout.headerBytes());
  for (std::size_t column = 0; column < std::min<std::size_t>(2, layout.columns); ++column)
  {
    const Bytes bytes = packet.slice(layout.columnOffset(column), layout.columnBytes());
    const std::size_t kept = layout.columnHeaderBytes() +
                             std::min<std::size_t>(kFuzzChannels, layout.channels) * layout.profile->channel_bytes;
    seed.insert(seed.end(), bytes.begin(), bytes.begin() + kept);
    seed.insert(seed.end(), bytes.end() - layout.columnFooterBytes(), bytes.end());
  }
  const Bytes footer = packet.slice(packet.size() - layout.footerBytes(), layout.footerBytes());
  seed.insert(seed.end(), footer.begin(), footer.end());
  return seed;
}

void addHesai(Bytes packet, Corpus& corpus)
{
  for (std::size_t i = 0; i < kHesaiModels.size(); ++i)
    if (packet.size() >= kHesaiModels[i].packetBytes() &&
        packet.size() <= kHesaiModels[i].packetBytes() + kHesaiModels[i].optional_bytes)
      corpus.add("lidar_hesai_packet", led({0, static_cast<std::uint8_t>(2 * i + 1)}, packet, 1300));
}

/** Whatever a capture holds, as each target would have it; the metadata file of the same name tells Ouster's apart. */
void addCapture(const fs::path& path, Corpus& corpus)
{
  corpus.add("packets_pcap", led({0xFF}, bytesOf(path), 1024));
  std::unique_ptr<OusterDecoder> ouster;
  if (const fs::path metadata = fs::path(path).replace_extension(".json"); fs::exists(metadata))
    ouster = std::make_unique<OusterDecoder>(loadOusterMetadata(metadata.string()), Rigid::identity());

  CaptureReader reader(path);
  std::map<std::size_t, std::size_t> of_size;
  for (Datagram datagram; reader.next(datagram);)
  {
    const Bytes packet = datagram.payload;
    if (of_size[packet.size()]++ >= kPacketsPerCapture) continue;
    addHesai(packet, corpus);
    if (packet.size() == kRobosensePacketBytes) corpus.add("lidar_robosense_packet", led({0, 0}, packet, 1300));
    if (packet.size() == kVelodynePacketBytes) corpus.add("lidar_velodyne_packet", led({0, 0}, packet, 1300));
    if (!ouster) continue;
    const PacketKind kind = ouster->kind(packet);
    if (kind == PacketKind::Lidar)
      corpus.add("lidar_ouster_packet", led({kAllMended, 0}, cutDown(*ouster, packet), 900));
    if (kind == PacketKind::Imu) corpus.add("lidar_ouster_packet", led({kAllMended | 8, 0}, packet, 900));
  }
}

void addMetadata(const fs::path& path, Corpus& corpus)
{
  const Seed text = bytesOf(path);
  const auto json = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
  if (!json.is_object()) return;
  const std::string dense = json.dump();
  const Bytes bytes(reinterpret_cast<const std::uint8_t*>(dense.data()), dense.size());
  if (bytes.size() < 2048) corpus.add("lidar_metadata", led({0xFF}, bytes, 2048));
}
}  // namespace

int main(int argc, char** argv)
{
  if (argc != 4)
  {
    std::fputs("usage: scanloom_fuzz_corpus RECORDINGS INIS OUT\n", stderr);
    return 2;
  }
  Corpus corpus(argv[3]);
  for (const auto& entry : fs::recursive_directory_iterator(argv[1]))
  {
    if (entry.path().extension() == ".json") addMetadata(entry.path(), corpus);
    if (entry.path().extension() != ".pcap" || entry.file_size() > 8'000'000) continue;
    try
    {
      addCapture(entry.path(), corpus);
    }
    catch (const std::exception& e)
    {
      std::fprintf(stderr, "left out: %s\n", e.what());
    }
  }
  for (const auto& entry : fs::recursive_directory_iterator(argv[2]))
    if (entry.path().extension() == ".ini") corpus.add("config_ini", led({}, bytesOf(entry.path()), 1024));
  for (const auto& [target, count] : corpus.counts()) std::printf("%-24s %d\n", target.c_str(), count);
  return corpus.counts().empty() ? 3 : 0;
}
