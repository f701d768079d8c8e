#pragma once
#include "input/batching/RoutedPacket.h"
#include "input/batching/Scan.h"
#include "input/batching/internal/PacketQueue.h"

#include <optional>

namespace scanloom
{
/** The paper's scan under construction: takes blocks in time order, gives out slices and scans as they are complete. */
class ScanUnderConstruction
{
 public:
  /** `start` is that of the first scan. */
  ScanUnderConstruction(Timestamp start, Duration period, int slices, std::size_t lidars);

  Timestamp start() const { return scan_.start; }
  Timestamp end() const { return scan_.end(); }
  const Scan& scan() const { return scan_; }

  enum class Place
  {
    Next,         // append() may be called
    Late,         // its slice has been given out, or a column that comes after it
    BeforeStart,  // of the first scan
  };
  Place placeOf(const MeasurementBlock&, LidarIndex) const;

  /** Converts the queue's oldest block into the next column; returns the number of its points. */
  std::size_t append(const PacketQueue&, LidarIndex);

  /** Slices that end at `time` or before; the sink may be empty. */
  void giveSlicesUntil(Timestamp time, const SliceSink&);

  /** The scan as it is, after the rest of its slices. The next one begins where it ends. */
  Scan close(SensorMask missing, const SliceSink&);

  /** Goes on with a scan so many periods later; this one must be empty. */
  void skip(std::int64_t periods);

 private:
  Timestamp sliceEnd(int slice) const { return scan_.start + scan_.period * (slice + 1) / slices_; }
  void openSlice(int slice);
  void giveSlice(const SliceSink&);

  Timestamp first_start_;  // t_init of eq. (1)
  int slices_;
  Scan scan_;
  int slice_ = 0;  // the open one of scan_
  Timestamp slice_begin_, slice_end_;
  std::size_t columns_given_ = 0;  // in the slices before it
  std::optional<Column> last_;     // the newest column of all scans
};
}  // namespace scanloom
