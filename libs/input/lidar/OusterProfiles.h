/**
 * The table of Ouster's lidar UDP profiles: where each field lies in a channel's bytes. Decoder, encoder and digests
 * all use it. Source: packet tables of the sensor manuals (firmware 2.0 to 3.x); profiles that they lack from the
 * public SDK 1.0.1.
 */
#pragma once
#include "base/core/Bytes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace scanloom
{
enum class OusterField : std::uint8_t
{
  Range,
  Flags,
  Reflectivity,
  Signal,
  NearIr,
  Range2,
  Flags2,
  Reflectivity2,
  Signal2,
  Window,
  ZoneMask,
  Red,  // the three colours are half floats
  Green,
  Blue,
};
constexpr std::size_t kOusterFieldCount = 14;

/** Ouster's name of a field, and the size of the integer for its value. */
struct OusterFieldType
{
  std::string_view name;
  std::size_t bytes;
};

constexpr std::array<OusterFieldType, kOusterFieldCount> kOusterFieldTypes{{
    {"RANGE", 4},
    {"FLAGS", 1},
    {"REFLECTIVITY", 1},
    {"SIGNAL", 2},
    {"NEAR_IR", 2},
    {"RANGE2", 4},
    {"FLAGS2", 1},
    {"REFLECTIVITY2", 1},
    {"SIGNAL2", 2},
    {"WINDOW", 1},
    {"ZONE_MASK", 2},
    {"R", 2},
    {"G", 2},
    {"B", 2},
}};

/** Bits of a channel, counted from the lowest bit of its first byte. The value is these bits times 2^shift. */
struct BitField
{
  std::uint8_t first = 0;
  std::uint8_t width = 0;  // 0: the profile has no such field
  std::uint8_t shift = 0;

  constexpr bool present() const { return width > 0; }
  constexpr std::size_t firstByte() const { return first / 8; }
  constexpr std::size_t byteCount() const { return (first % 8 + width + 7) / 8; }
  constexpr std::uint32_t mask() const { return width == 32 ? 0xFFFFFFFFu : (1u << width) - 1u; }
};

struct OusterProfile
{
  std::string_view name;
  std::size_t channel_bytes = 0;
  std::array<BitField, kOusterFieldCount> fields{};  // by OusterField

  constexpr BitField operator[](OusterField f) const { return fields[static_cast<std::size_t>(f)]; }
  constexpr int returns() const { return (*this)[OusterField::Range2].present() ? 2 : 1; }
};

namespace ouster_profiles
{
struct Row
{
  OusterField field;
  std::uint8_t first, width, shift = 0;
};

constexpr OusterProfile profile(std::string_view name, std::size_t channel_bytes, std::initializer_list<Row> rows)
{
  OusterProfile p{name, channel_bytes, {}};
  for (const Row& r : rows) p.fields[static_cast<std::size_t>(r.field)] = BitField{r.first, r.width, r.shift};
  return p;
}

using F = OusterField;

/** The first three words are the same in all 19 bit profiles with two returns. */
constexpr OusterProfile dual19(std::string_view name, std::size_t channel_bytes, std::initializer_list<Row> rest)
{
  OusterProfile p = profile(name, channel_bytes,
                            {{F::Range, 0, 19},
                             {F::Flags, 19, 5},
                             {F::Reflectivity, 24, 8},
                             {F::Range2, 32, 19},
                             {F::Flags2, 51, 5},
                             {F::Reflectivity2, 56, 8},
                             {F::Signal, 64, 16},
                             {F::Signal2, 80, 16}});
  for (const Row& r : rest) p.fields[static_cast<std::size_t>(r.field)] = BitField{r.first, r.width, r.shift};
  return p;
}

/** The first word is the same in all low-rate profiles; ranges have steps of 8 mm. */
constexpr OusterProfile low15(std::string_view name, std::size_t channel_bytes, std::initializer_list<Row> rest)
{
  OusterProfile p = profile(name, channel_bytes, {{F::Range, 0, 15, 3}, {F::Flags, 15, 1}, {F::Reflectivity, 16, 8}});
  for (const Row& r : rest) p.fields[static_cast<std::size_t>(r.field)] = BitField{r.first, r.width, r.shift};
  return p;
}

constexpr OusterProfile low15Dual(std::string_view name)
{
  return low15(name, 8,
               {{F::NearIr, 24, 8, 4},
                {F::Range2, 32, 15, 3},
                {F::Flags2, 47, 1},
                {F::Reflectivity2, 48, 8},
                {F::Window, 56, 8}});
}
}  // namespace ouster_profiles

inline constexpr std::array kOusterProfiles{
    // The reflectivity is in the second word of profiles with one return, in the first word with two returns.
    ouster_profiles::profile("LEGACY", 12,
                             {{OusterField::Range, 0, 20},
                              {OusterField::Flags, 28, 4},
                              {OusterField::Reflectivity, 32, 8},
                              {OusterField::Signal, 48, 16},
                              {OusterField::NearIr, 64, 16}}),
    ouster_profiles::profile("RNG19_RFL8_SIG16_NIR16", 12,
                             {{OusterField::Range, 0, 19},
                              {OusterField::Flags, 19, 5},
                              {OusterField::Reflectivity, 32, 8},
                              {OusterField::Signal, 48, 16},
                              {OusterField::NearIr, 64, 16},
                              {OusterField::Window, 88, 8}}),
    ouster_profiles::dual19("RNG19_RFL8_SIG16_NIR16_DUAL", 16,
                            {{OusterField::NearIr, 96, 16}, {OusterField::Window, 120, 8}}),
    ouster_profiles::low15("RNG15_RFL8_NIR8", 4, {{OusterField::NearIr, 24, 8, 4}}),
    ouster_profiles::low15("RNG15_RFL8_WIN8", 4, {{OusterField::Window, 24, 8}}),
    ouster_profiles::low15Dual("RNG15_RFL8_NIR8_DUAL"),
    ouster_profiles::low15Dual("FUSA_RNG15_RFL8_NIR8_DUAL"),
    ouster_profiles::low15(
        "RNG15_RFL8_NIR8_ZONE16", 8,
        {{OusterField::NearIr, 24, 8, 4}, {OusterField::ZoneMask, 32, 16}, {OusterField::Window, 48, 8}}),
    ouster_profiles::profile("RNG19_RFL8_SIG16_NIR16_ZONE16", 12,
                             {{OusterField::Range, 0, 19},
                              {OusterField::Flags, 19, 5},
                              {OusterField::Reflectivity, 32, 8},
                              {OusterField::Window, 40, 8},
                              {OusterField::Signal, 48, 16},
                              {OusterField::NearIr, 64, 16},
                              {OusterField::ZoneMask, 80, 16}}),
    ouster_profiles::dual19("RNG19_RFL8_SIG16_ZONE16_DUAL", 16,
                            {{OusterField::ZoneMask, 96, 16}, {OusterField::Window, 120, 8}}),
    ouster_profiles::profile("RNG19_RFL8_SIG16_NIR16_RGB16", 16,
                             {{OusterField::Range, 0, 19},
                              {OusterField::Flags, 19, 5},
                              {OusterField::Reflectivity, 24, 8},
                              {OusterField::Signal, 32, 16},
                              {OusterField::NearIr, 48, 16},
                              {OusterField::Red, 64, 16},
                              {OusterField::Green, 80, 16},
                              {OusterField::Blue, 96, 16}}),
    ouster_profiles::dual19("RNG19_RFL8_SIG16_NIR16_RGB16_DUAL", 20,
                            {{OusterField::NearIr, 96, 16},
                             {OusterField::Red, 112, 16},
                             {OusterField::Green, 128, 16},
                             {OusterField::Blue, 144, 16}}),
    ouster_profiles::dual19("FIVE_WORD_PIXEL", 20, {{OusterField::NearIr, 96, 16}, {OusterField::Window, 120, 8}}),
};

/** The row of that name, or null. */
const OusterProfile* findOusterProfile(std::string_view name);

/** Whether all fields lie inside the channel and fit into their types. */
constexpr bool isConsistent(const OusterProfile& p)
{
  for (std::size_t i = 0; i < kOusterFieldCount; ++i)
  {
    const BitField f = p.fields[i];
    if (f.first + f.width > 8 * p.channel_bytes) return false;
    if (f.byteCount() > 4 || f.width + f.shift > 8u * kOusterFieldTypes[i].bytes) return false;
  }
  return p[OusterField::Range].present();
}

/** The value of a field of one channel. Throws std::out_of_range if `channel` is too short. */
inline std::uint32_t readField(Bytes channel, BitField f)
{
  const auto word = static_cast<std::uint32_t>(loadUnsigned(channel, f.firstByte(), f.byteCount()));
  return ((word >> (f.first % 8)) & f.mask()) << f.shift;
}

/** Writes `value`, rounded to the field's steps and limited to its largest value. Throws std::out_of_range. */
inline void writeField(std::vector<std::uint8_t>& packet, std::size_t channel_offset, BitField f, std::uint32_t value)
{
  const std::size_t first = channel_offset + f.firstByte();
  const std::uint64_t steps = (std::uint64_t{value} + ((1u << f.shift) >> 1)) >> f.shift;
  std::uint64_t word = loadUnsigned(packet, first, f.byteCount());
  word &= ~(std::uint64_t{f.mask()} << (f.first % 8));
  word |= std::min<std::uint64_t>(steps, f.mask()) << (f.first % 8);
  std::memcpy(packet.data() + first, &word, f.byteCount());  // loadUnsigned has checked the bounds
}
}  // namespace scanloom
