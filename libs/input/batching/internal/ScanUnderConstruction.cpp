#include "input/batching/internal/ScanUnderConstruction.h"

#include <tuple>
#include <utility>

namespace scanloom
{
namespace
{
Scan emptyScan(Timestamp start, Duration period, std::size_t lidars)
{
  Scan scan;
  scan.start = start;
  scan.period = period;
  scan.columns_of.assign(lidars, 0);
  return scan;
}
}  // namespace

ScanUnderConstruction::ScanUnderConstruction(Timestamp start, Duration period, int slices, std::size_t lidars)
  : first_start_(start), slices_(slices), scan_(emptyScan(start, period, lidars))
{
  openSlice(0);
}

void ScanUnderConstruction::openSlice(int slice)
{
  slice_ = slice;
  slice_begin_ = sliceEnd(slice - 1);
  slice_end_ = sliceEnd(slice);
}

void ScanUnderConstruction::skip(std::int64_t periods)
{
  scan_.start += periods * scan_.period;
  openSlice(slice_);
}

ScanUnderConstruction::Place ScanUnderConstruction::placeOf(const MeasurementBlock& block, LidarIndex lidar) const
{
  if (block.stamp < first_start_) return Place::BeforeStart;
  const bool in_order = !last_ || std::tuple(block.stamp, lidar, block.measurement_id) >
                                      std::tuple(last_->stamp, LidarIndex{last_->sensor_id}, last_->measurement_id);
  return in_order && block.stamp >= slice_begin_ ? Place::Next : Place::Late;
}

std::size_t ScanUnderConstruction::append(const PacketQueue& queue, LidarIndex lidar)
{
  const MeasurementBlock& block = queue.front();
  Column column;
  column.stamp = block.stamp;
  column.first_point = static_cast<std::uint32_t>(scan_.points.size());
  column.measurement_id = block.measurement_id;
  column.frame_id = block.frame_id;
  column.sensor_id = static_cast<std::uint8_t>(lidar);
  const auto t = static_cast<std::int32_t>((block.stamp - scan_.start).count());
  queue.frontDecoder().appendPoints(queue.frontPacket(), block.index, t, column.sensor_id, scan_.points);
  column.count = static_cast<std::uint16_t>(scan_.points.size() - column.first_point);
  scan_.columns.push_back(column);
  ++scan_.columns_of[lidar];
  last_ = column;
  return column.count;
}

void ScanUnderConstruction::giveSlicesUntil(Timestamp time, const SliceSink& sink)
{
  while (time >= slice_end_) giveSlice(sink);
}

void ScanUnderConstruction::giveSlice(const SliceSink& sink)
{
  const std::size_t end = scan_.columns.size();
  if (sink) sink({scan_, slice_, slices_, columns_given_, end});
  columns_given_ = end;
  openSlice(slice_ + 1);
}

Scan ScanUnderConstruction::close(SensorMask missing, const SliceSink& sink)
{
  scan_.missing = missing;
  while (slice_ < slices_) giveSlice(sink);
  columns_given_ = 0;
  Scan next = emptyScan(scan_.end(), scan_.period, scan_.columns_of.size());
  next.points.reserve(scan_.points.size() + scan_.points.size() / 16);
  Scan closed = std::exchange(scan_, std::move(next));
  openSlice(0);
  return closed;
}
}  // namespace scanloom
