/** The table of Velodyne models: what differs between sensors with the same packet format. */
#pragma once
#include "base/core/Time.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace scanloom
{
constexpr std::size_t kVelodyneReadings = 12 * 32;  // of a packet

/**
 * All lasers fire once per sequence, `lasers_per_shot` at a time. Readings of a packet are in firing order: 24
 * sequences of 16 lasers, 12 of 32 or 3 of 128.
 */
struct VelodyneModel
{
  std::string_view name;  // as in metadata: "VLP-16"
  std::uint8_t product_id = 0;
  int channels = 0;
  int lasers_per_shot = 1;
  Duration shot;                  // from one shot to the next within a sequence
  int shots_before_pause = 1000;  // after this many shots comes a pause of one
  Duration sequence;              // from one sequence to the next
  Duration first_shot{0};         // time of a packet's first shot after its stamp
  int range_unit_mm = 2;
  bool dual_return = true;            // false: its format of two returns is not known
  std::uint8_t early_product_id = 0;  // of the first ones that were built; 0: they have the same

  std::size_t sequencesPerPacket() const { return kVelodyneReadings / static_cast<std::size_t>(channels); }

  /** Time of a laser's shot after the first one of the sequence. */
  constexpr Duration shotTime(int laser) const
  {
    const int number = laser / lasers_per_shot;
    return shot * (number + number / shots_before_pause);
  }
};

/**
 * Timing, units and product ids are those of the maker's manuals (VLP-16 63-9243, HDL-32E 63-9113, VLP-32C 63-9325);
 * for the VLS-128 of the ROS driver, but with a sequence every 55.277 us (driver: 53.3 us) and the product id 0xA1, as
 * in the recording at hand. The first VLP-16s bear the product id of the HDL-32E.
 */
constexpr std::array<VelodyneModel, 4> kVelodyneModels{{
    {"VLP-16", 0x22, 16, 1, 2304ns, 1000, 55296ns, 0ns, 2, true, 0x21},
    {"HDL-32E", 0x21, 32, 1, 1152ns, 1000, 46080ns, 0ns, 2, true, 0},
    {"VLP-32C", 0x28, 32, 2, 2304ns, 1000, 55296ns, 0ns, 4, true, 0},
    {"VLS-128", 0xA1, 128, 8, 2665ns, 8, 55277ns, -8700ns, 4, false, 0},
}};

/** The row of that name, or null. */
constexpr const VelodyneModel* findVelodyneModel(std::string_view name)
{
  for (const VelodyneModel& model : kVelodyneModels)
    if (model.name == name) return &model;
  return nullptr;
}
}  // namespace scanloom
