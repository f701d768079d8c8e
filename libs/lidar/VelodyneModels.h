/** THE table of Velodyne models: what differs between sensors that share one packet format. */
#pragma once
#include "core/Time.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace scanloom
{
constexpr std::size_t kVelodyneReadings = 12 * 32;  // of a packet, in the order of firing

/**
 * All lasers fire once per sequence, `lasers_per_shot` at a time. A packet is a run of readings in firing order, so
 * the number of lasers alone says how sequences lie in it: 24 of 16 lasers, 12 of 32 or 3 of 128.
 */
struct VelodyneModel
{
  std::string_view name;  // as in metadata: "VLP-16"
  std::uint8_t product_id = 0;
  int channels = 0;
  int lasers_per_shot = 1;
  Duration shot;                  // from one shot to the next within a sequence
  int shots_before_pause = 1000;  // after these, one shot's time is left out
  Duration sequence;              // from one sequence to the next
  Duration first_shot{0};         // of a packet, after the packet's stamp
  int range_unit_mm = 2;
  bool dual_return = true;  // false: how it packs two returns is not known here

  std::size_t sequencesPerPacket() const { return kVelodyneReadings / static_cast<std::size_t>(channels); }

  /** Of a laser's shot after the first one of its sequence. */
  constexpr Duration shotTime(int laser) const
  {
    const int number = laser / lasers_per_shot;
    return shot * (number + number / shots_before_pause);
  }
};

/**
 * Timing, units and product ids are those of the maker's manuals (VLP-16 63-9243, HDL-32E 63-9113, VLP-32C 63-9325)
 * and, for the VLS-128, of the common ROS driver. Where a recording says otherwise, it wins: the VLS-128 at hand fires
 * a sequence every 55.277 us (53.3 us in the driver) and calls itself 0xA1.
 */
constexpr std::array<VelodyneModel, 4> kVelodyneModels{{
    {"VLP-16", 0x22, 16, 1, 2304ns, 1000, 55296ns, 0ns, 2, true},
    {"HDL-32E", 0x21, 32, 1, 1152ns, 1000, 46080ns, 0ns, 2, true},
    {"VLP-32C", 0x28, 32, 2, 2304ns, 1000, 55296ns, 0ns, 4, true},
    {"VLS-128", 0xA1, 128, 8, 2665ns, 8, 55277ns, -8700ns, 4, false},
}};

/** Nothing if there is no such model. */
constexpr const VelodyneModel* findVelodyneModel(std::string_view name)
{
  for (const VelodyneModel& model : kVelodyneModels)
    if (model.name == name) return &model;
  return nullptr;
}
}  // namespace scanloom
