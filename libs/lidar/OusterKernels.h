/** What the kernels of OusterPoints have in common. They include nothing that could be compiled into inline functions.
 */
#pragma once
#include "lidar/OusterPoints.h"

#include <array>
#include <utility>

namespace scanloom::ouster_kernels
{
/** One function per row of kOusterProfiles. */
using Table = std::array<OusterPoints::Write, kOusterProfiles.size()>;
extern const Table kPortable;
extern const Table kAvx2;
extern const Table kAvx512;

/** Kernels write whole vectors: up to the end of the last block of each return, and 64 bytes of what is the same. */
constexpr std::size_t roomFor(std::size_t beams, int returns)
{
  return static_cast<std::size_t>(returns) * ((beams + 15) / 16 * 16) + 64;
}

enum class Return
{
  First,
  Second,
};

/**
 * How one operation moves a field from its 32 bit word of the channel to bit kTo of another word: a shift, to the left
 * where kShift is positive, and a mask where other bits would come along. Every field lies within one word.
 */
template <std::size_t kProfile, OusterField kField, int kTo = 0>
struct Move
{
  static constexpr BitField kBits = kOusterProfiles[kProfile][kField];
  static constexpr bool kPresent = kBits.present();
  static constexpr int kWord = kBits.first / 32;
  static constexpr int kShift = kTo + kBits.shift - kBits.first % 32;
  static constexpr std::uint32_t kMask = kBits.mask() << (kTo + kBits.shift);
  static constexpr std::uint32_t kLeft = kShift < 0 ? 0xFFFFFFFFu >> -kShift : 0xFFFFFFFFu << kShift;
  static constexpr bool kNeedsMask = kMask != kLeft;
  static_assert(kBits.first % 32 + kBits.width <= 32 && kTo + kBits.shift + kBits.width <= 32);
};

/** Words of a channel. */
template <std::size_t kProfile>
constexpr int kWords = kOusterProfiles[kProfile].channel_bytes / 4;

/** The fields of one return. */
template <Return kReturn>
struct Fields
{
  static constexpr bool kFirst = kReturn == Return::First;
  static constexpr OusterField kReflectivity = kFirst ? OusterField::Reflectivity : OusterField::Reflectivity2;
  static constexpr OusterField kSignal = kFirst ? OusterField::Signal : OusterField::Signal2;
};
/**
 * Asks for the lines that the next column is going to fill. Stores leave the processor in order, so each one whose line
 * is still far away holds up all that follow it, those of other fields too.
 */
constexpr std::size_t kAhead = 128;  // points

/** Once per block of sixteen points: a line of each field of four bytes. */
[[gnu::always_inline]] inline void fetchWideFields(const PointRoom& to, std::size_t n)
{
  __builtin_prefetch(to.x + n + kAhead, 1);
  __builtin_prefetch(to.y + n + kAhead, 1);
  __builtin_prefetch(to.z + n + kAhead, 1);
  __builtin_prefetch(to.range + n + kAhead, 1);
  __builtin_prefetch(to.t + n + kAhead, 1);
}

/** Once per column. */
[[gnu::always_inline]] inline void fetchNarrowFields(const PointRoom& to, std::size_t n)
{
  for (std::size_t ahead = kAhead; ahead < 2 * kAhead; ahead += 32)
  {
    __builtin_prefetch(to.signal + n + ahead, 1);
    __builtin_prefetch(to.near_ir + n + ahead, 1);
    __builtin_prefetch(to.column + n + ahead, 1);
  }
  for (std::size_t ahead = kAhead; ahead < 2 * kAhead; ahead += 64)
  {
    __builtin_prefetch(to.intensity + n + ahead, 1);
    __builtin_prefetch(to.ring + n + ahead, 1);
    __builtin_prefetch(to.sensor_id + n + ahead, 1);
  }
}
}  // namespace scanloom::ouster_kernels
