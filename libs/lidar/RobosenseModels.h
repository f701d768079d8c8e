/** The table of Robosense models: what differs between sensors whose packets are built alike. */
#pragma once
#include "core/Time.h"

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
};

/**
 * Types, versions and layout are those of the user manuals; shots and lens are those of drivers. Of the old types, 6 is
 * the Helios-5515's alone.
 */
constexpr std::array<RobosenseModel, 4> kRobosenseModels{{
    {"Helios-5515", 32, 6, 1, 6, kShotsOfHelios.data()},
    {"Helios-1610", 32, 6, 2, 7, kShotsOfHelios.data()},
    {"Helios-1615", 32, 6, 4, 7, kShotsOfHelios.data()},
    {"Helios-16P", 16, 6, 3, 7, kShotsOfHelios16P.data()},
}};

/** The row of that name, or null. */
constexpr const RobosenseModel* findRobosenseModel(std::string_view name)
{
  for (const RobosenseModel& model : kRobosenseModels)
    if (model.name == name) return &model;
  return nullptr;
}
}  // namespace scanloom
