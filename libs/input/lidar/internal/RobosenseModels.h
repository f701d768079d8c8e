/** The table of Robosense models: what differs between sensors whose packets are built alike. */
#pragma once
#include "base/core/Time.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace scanloom
{
constexpr std::size_t kRobosenseBlocks = 12, kRobosenseReadings = kRobosenseBlocks * 32;  // of a packet

/** When channels fire after the first one, in ns: beams 18 and 22 (counted from 0) before 17 and 21. */
constexpr std::array<std::int32_t, 32> kShotsOfHelios{
    0,     1570,  3150,  4720,  6300,  7870,  9450,  11360, 13260, 15170, 17080, 18990, 20560, 22140, 23710, 25290,
    26530, 29010, 27770, 30250, 31490, 33980, 32730, 35220, 36460, 37700, 38940, 40180, 41420, 42670, 43910, 45150};

/** Of two channels of a Helios, the first. */
constexpr std::array<std::int32_t, 16> kShotsOfHelios16P{0,     3150,  6300,  9450,  13260, 17080, 20560, 23710,
                                                         26530, 27770, 31490, 32730, 36460, 38940, 41420, 43910};

/** Of the Bpearl of version 3: two halves of sixteen channels fire in turn. */
constexpr std::array<std::int32_t, 32> kShotsOfBpearl3{
    0,    2560, 5120, 7680, 10240, 12800, 15360, 17920, 25680, 28240, 30800, 33360, 35920, 38480, 41040, 43600,
    1280, 3840, 6400, 8960, 11520, 14080, 16640, 19200, 26960, 29520, 32080, 34640, 37200, 39760, 42320, 44880};

constexpr std::array<std::int32_t, 32> kShotsOfBpearl4{
    0,     1670,  3340,  5000,  6670,  8340,  10010, 11680, 13340, 15010, 16680, 18350, 20020, 21680, 23350, 25020,
    26690, 28360, 30020, 31690, 33360, 35030, 36700, 38360, 40030, 41700, 43370, 45040, 46700, 48370, 50040, 51710};

enum class RobosenseClock
{
  Seconds,   // since 1970, and microseconds
  Calendar,  // year to second, milliseconds, microseconds
};

/** All channels fire once per sequence; a packet holds 12 sequences of 32 readings, or 24 of 16. */
struct RobosenseModel
{
  std::string_view name;
  int channels = 0;
  std::uint8_t type = 0, version = 0;   // as packets name it
  std::uint8_t old_type = 0;            // as packets that have no version name it
  const std::int32_t* shots = nullptr;  // by channel
  Duration sequence{55560};             // from one firing of all channels to the next
  double lens_m = 0.03498;              // of the lens from the axis of rotation, towards the azimuth
  double lens_z_m = 0;                  // of the lens above the sensor's origin
  std::uint32_t marker = 0x55AA055A;    // begins a packet
  double unit_mm = 0;                   // of ranges; 0: the packet tells
  RobosenseClock clock = RobosenseClock::Seconds;
};

constexpr std::uint32_t kBpearl = 0x55AA050A;  // begins packets of a Bpearl

/**
 * Types, versions and layout are those of the user manuals (of the Bpearl those of drivers); shots and lens are those
 * of drivers. Of the old types, 6 is the Helios-5515's alone.
 */
constexpr std::array<RobosenseModel, 6> kRobosenseModels{{
    {"Helios-5515", 32, 6, 1, 6, kShotsOfHelios.data()},
    {"Helios-1610", 32, 6, 2, 7, kShotsOfHelios.data()},
    {"Helios-1615", 32, 6, 4, 7, kShotsOfHelios.data()},
    {"Helios-16P", 16, 6, 3, 7, kShotsOfHelios16P.data()},
    {"Bpearl-V3", 32, 3, 0, 3, kShotsOfBpearl3.data(), Duration{55520}, 0.01473, 0.09427, kBpearl, 5,
     RobosenseClock::Calendar},
    {"Bpearl-V4", 32, 3, 4, 0, kShotsOfBpearl4.data(), Duration{55560}, 0.01619, 0.09571, kBpearl, 2.5,
     RobosenseClock::Seconds},
}};

/** The row of that name, or null. */
constexpr const RobosenseModel* findRobosenseModel(std::string_view name)
{
  for (const RobosenseModel& model : kRobosenseModels)
    if (model.name == name) return &model;
  return nullptr;
}
}  // namespace scanloom
