#include "input/bags/BagPackets.h"

#include "input/bags/MessagePackets.h"
#include "input/packets/CaptureReader.h"

#include <set>

namespace scanloom
{
namespace
{
using Path = std::filesystem::path;

class BagPackets : public DatagramReader
{
 public:
  BagPackets(const Path& path, const std::set<std::string>& topics) : bag_(BagReader::open(path)), packets_(topics) {}

  bool next(Datagram& datagram) override
  {
    while (!packets_.next(datagram))
    {
      if (at_end_) return false;
      readMessage();
    }
    return true;
  }

  CaptureCounters counters() const override
  {
    CaptureCounters counters = packets_.counters();
    counters.damages = damages_;
    return counters;
  }

  double progress() const override { return bag_->progress(); }

 private:
  void readMessage()
  {
    BagMessage message;
    at_end_ = !bag_->next(message);
    for (std::string& warning : bag_->takeWarnings()) damages_.push_back(std::move(warning));
    if (at_end_)
      packets_.flush();
    else
      packets_.take(bag_->topics()[message.topic], message);
  }

  std::unique_ptr<BagReader> bag_;
  MessagePackets packets_;
  std::vector<std::string> damages_;
  bool at_end_ = false;
};
}  // namespace

std::set<std::string> packetTopicsOf(const std::vector<Path>& recordings)
{
  std::set<std::string> topics, clouds;
  for (const BagTopic& topic : topicsOf(recordings))
  {
    if (holdsPackets(topic.type)) topics.insert(topic.name);
    if (holdsClouds(topic.type)) clouds.insert(topic.name);
  }
  return topics.empty() ? clouds : topics;
}

std::vector<std::unique_ptr<DatagramReader>> datagramsOf(const std::vector<Path>& recordings)
{
  const std::set<std::string> topics = packetTopicsOf(recordings);
  std::vector<std::unique_ptr<DatagramReader>> readers;
  for (const Path& path : recordings)
    if (isBag(path))
      readers.push_back(std::make_unique<BagPackets>(path, topics));
    else
      readers.push_back(std::make_unique<CaptureReader>(path));
  return readers;
}
}  // namespace scanloom
