#include "input/packets/CaptureReader.h"

#include "base/formats/CompressedFile.h"
#include "base/formats/FileFormat.h"
#include "input/packets/internal/CaptureRecords.h"
#include "input/packets/internal/LinkLayer.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace scanloom
{
CaptureCounters operator+(const CaptureCounters& a, const CaptureCounters& b)
{
  std::vector<std::string> damages = a.damages;
  damages.insert(damages.end(), b.damages.begin(), b.damages.end());
  return {a.records + b.records,
          a.datagrams + b.datagrams,
          a.fragments_joined + b.fragments_joined,
          a.fragments_expired + b.fragments_expired,
          a.not_udp + b.not_udp,
          a.cut_short + b.cut_short,
          a.malformed + b.malformed,
          a.truncated || b.truncated,
          std::move(damages)};
}

CaptureReader::CaptureReader(const std::filesystem::path& path) : path_(path)
{
  try
  {
    file_ = std::make_unique<CompressedFile>(path);
    records_ = recordsOf(*file_);
  }
  catch (const OtherLinkType& link)
  {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), link.what()));
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(fmt::format("{}: {}; a pcap or pcapng capture of UDP packets is needed ({})",
                                         path.string(), describeFile(path), error.what()));
  }
  file_size_ = static_cast<double>(std::filesystem::file_size(path));
}

CaptureReader::CaptureReader(CaptureReader&&) noexcept = default;
CaptureReader::~CaptureReader() = default;

bool CaptureReader::next(Datagram& datagram)
{
  while (const auto record = nextRecord())
  {
    ++counters_.records;
    bytes_read_ += record->frame.size();
    try
    {
      if (!isKnownLinkType(record->link_type))
      {
        other_link_type_ = record->link_type;
        ++other_links_;
        ++counters_.not_udp;
      }
      else if (record->frame.size() < record->length)
        ++counters_.cut_short;
      else if (readDatagram(*record, datagram))
        return true;
    }
    catch (const std::out_of_range&)
    {
      ++counters_.malformed;
    }
  }
  joiner_.finish();
  if (other_links_ > 0 && other_links_ == counters_.records)
    throw std::runtime_error(fmt::format("{}: {}", path_.string(), OtherLinkType(other_link_type_).what()));
  return false;
}

CaptureCounters CaptureReader::counters() const
{
  CaptureCounters counters = counters_;
  counters.fragments_joined = joiner_.joined();
  counters.fragments_expired = joiner_.lost();
  return counters;
}

double CaptureReader::progress() const
{
  if (file_size_ == 0) return 0;
  // The file is read ahead of the records, and a compressed one has fewer bytes than they.
  return ended_ ? 1 : static_cast<double>(std::min(bytes_read_, file_->bytesRead())) / file_size_;
}

/** Nothing at the end and, with a word in the counters, at a damage. */
std::optional<CaptureRecord> CaptureReader::nextRecord()
{
  if (ended_) return std::nullopt;
  try
  {
    if (auto record = records_->next()) return record;
  }
  catch (const CutCapture&)
  {
    counters_.truncated = true;
  }
  catch (const DamagedCapture& damage)
  {
    counters_.damages.push_back(
        fmt::format("{}: damaged after record {}: {}", path_.string(), counters_.records, damage.what()));
    if (counters_.records > 0)
      counters_.damages.back() +=
          fmt::format("; 'editcap -r {} good.pcap 1-{}' keeps the part before", path_.string(), counters_.records);
  }
  catch (const std::runtime_error& damage)  // of the compressed file
  {
    counters_.damages.push_back(fmt::format("{}; it was read up to record {}", damage.what(), counters_.records));
  }
  ended_ = true;
  return std::nullopt;
}

/** False if the record completes no datagram: not UDP, or a fragment with others still missing. */
bool CaptureReader::readDatagram(const CaptureRecord& record, Datagram& datagram)
{
  if (!record.stamp) throw std::out_of_range("stamp");
  const std::optional<Bytes> packet = ipPacketOf(record.link_type, record.frame);
  IpContent content = packet ? ipContentOf(*packet) : IpContent{};
  const bool may_be_udp = content.protocol == kUdp || (content.isFragment() && isExtension(content.protocol));
  if (may_be_udp && content.isFragment())
  {
    if (!joiner_.add(*record.stamp, content, joined_)) return false;
    content.payload = joined_;
    skipExtensions(content.protocol, content.payload);
  }
  if (content.protocol != kUdp)
  {
    ++counters_.not_udp;
    return false;
  }

  const UdpContent udp = udpContentOf(content.payload);
  datagram.received = *record.stamp;
  datagram.source = content.source;
  datagram.source_port = udp.source_port;
  datagram.destination_port = udp.destination_port;
  datagram.payload.assign(udp.payload.begin(), udp.payload.end());
  ++counters_.datagrams;
  return true;
}
}  // namespace scanloom
