/**
 * Shared by the kernels of OusterPoints. Kernels are compiled for other instruction sets: they must not include inline
 * functions that the linker could also take for the rest of the program.
 */
#pragma once
#include "input/lidar/internal/OusterPoints.h"

#include <array>
#include <utility>

namespace scanloom::ouster_kernels
{
/** One function per row of kOusterProfiles. */
using Table = std::array<OusterPoints::Write, kOusterProfiles.size()>;
extern const Table kPortable;
extern const Table kAvx2;

/** Points that a kernel may write: whole vectors, so more than there are returns. */
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
 * How to move a field from its 32 bit word of the channel to bit kTo of another word: shift by kShift (to the left if
 * positive), then mask if kNeedsMask. Every field lies within one word.
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

/** Number of 32 bit words of a channel. */
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
 * Prefetches the cache lines that the next column will fill. Stores complete in order: one whose line is not yet in the
 * cache delays all that follow.
 */
constexpr std::size_t kAhead = 128;  // points

/** To be called per block of sixteen points: one cache line of each field of four bytes. */
[[gnu::always_inline]] inline void fetchWideFields(const PointRoom& to, std::size_t n)
{
  __builtin_prefetch(to.x + n + kAhead, 1);
  __builtin_prefetch(to.y + n + kAhead, 1);
  __builtin_prefetch(to.z + n + kAhead, 1);
  __builtin_prefetch(to.range + n + kAhead, 1);
  __builtin_prefetch(to.t + n + kAhead, 1);
}

/** To be called per column. */
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
