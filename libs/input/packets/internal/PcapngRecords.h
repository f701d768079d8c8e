/**
 * pcapng as IETF's draft-ietf-opsawg-pcapng describes it. libpcap reads it, too, but refuses a file whose interfaces
 * differ in link type or snapshot length, which `mergecap` and a capture of "any" interface write.
 */
#pragma once
#include "input/packets/internal/CaptureRecords.h"

#include <cstdint>
#include <vector>

namespace scanloom
{
inline const std::vector<char> kPcapngMagic{'\x0A', '\x0D', '\x0D', '\x0A'};

class PcapngRecords : public CaptureRecords
{
 public:
  /** `file` stands behind the magic. Throws what next() throws if the section's header is damaged. */
  explicit PcapngRecords(CompressedFile& file);

  /** Of enhanced, simple and (obsolete) packet blocks; a simple one has no stamp of its own and gets that of 1970. */
  std::optional<CaptureRecord> next() override;

 private:
  struct Interface
  {
    int link_type = 0;
    std::uint32_t snap_length = 0;    // bytes; 0: none
    std::uint8_t resolution = 6;      // of stamps, 10^-6 s; with the highest bit set it is a power of two
    std::int64_t offset_seconds = 0;  // to be added to stamps
  };

  void readSection();
  std::optional<std::uint32_t> nextBlock();
  void readBody(std::uint32_t block_length, std::size_t bytes_before);
  void addInterface();
  CaptureRecord packet(std::size_t interface) const;
  CaptureRecord simplePacket() const;
  const Interface& interfaceAt(std::size_t number) const;
  template <typename T>
  T field(std::size_t offset) const;

  CompressedFile& file_;
  bool big_endian_ = false;            // of the current section
  std::vector<Interface> interfaces_;  // of the current section
  std::vector<std::uint8_t> body_;     // of the current block, between its two lengths
};
}  // namespace scanloom
