/**
 * A rawlog, packed by gzip, with a damaged object of each class that we read between sound ones. The first byte chooses
 * the object, the second the reader, and what the rest of the input is: changes of its bytes, or all that follows its
 * name. Few runs by default: MRPT's exceptions take milliseconds.
 * fuzz options: -max_len=512 -malloc_limit_mb=200 -rss_limit_mb=1024 -runs=4000
 */
#include "MemoryFile.h"
#include "base/core/Bytes.h"
#include "mrpt/observations/CGenericPointsMap.h"
#include "mrpt/observations/GzipArchive.h"
#include "mrpt/observations/RawlogInfo.h"
#include "mrpt/observations/RawlogInput.h"
#include "mrpt/observations/RawlogReader.h"
#include "mrpt/observations/registerClasses.h"

#include <mrpt/maps/CColouredPointsMap.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/maps/CWeightedPointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <array>
#include <stdexcept>

using namespace scanloom;
using mrpt::serialization::CSerializable;
using Buffer = std::vector<std::uint8_t>;

namespace
{
constexpr std::size_t kName = 1;  // byte of its length before it

Buffer bytesOf(const CSerializable& object)
{
  Buffer bytes;
  mrpt::serialization::ObjectToOctetVector(&object, bytes);
  return bytes;
}

RecordingHeader twoLidars()
{
  RecordingHeader header;
  header.scan_rate = 10;
  header.version = "1";
  for (const char* name : {"left", "right"}) header.lidars.push_back({name, "1", "OS-0-128", {}, 128, 1024, ""});
  return header;
}

Scan smallScan()
{
  Scan scan;
  scan.start = fromNanoseconds(1'700'000'000'000'000'000);
  scan.period = 100ms;
  scan.points.resize(12);
  for (std::size_t i = 0; i < 12; ++i)
  {
    scan.points.x[i] = static_cast<float>(i);
    scan.points.t[i] = static_cast<std::int32_t>(2'000'000 * (i / 3));
    scan.points.column[i] = static_cast<std::uint16_t>(i / 3);
    scan.points.sensor_id[i] = i < 6 ? 0 : 1;
  }
  return scan;
}

mrpt::obs::CObservationPointCloud::Ptr cloudOf(const mrpt::maps::CPointsMap::Ptr& points)
{
  auto cloud = toObservation(Scan{});
  points->resize(3);  // MRPT 2.15's insertPoint() adds no weights
  for (std::size_t i = 0; i < 3; ++i) points->setPoint(i, 1, 2, static_cast<float>(i));
  cloud->pointcloud = points;
  return cloud;
}

Buffer actions()
{
  mrpt::obs::CActionCollection collection;
  mrpt::obs::CActionRobotMovement2D movement;
  movement.computeFromOdometry({1, 2, 3}, {});
  collection.insert(movement);
  return bytesOf(collection);
}

Buffer frameOf(const mrpt::obs::CObservation::Ptr& observation)
{
  mrpt::obs::CSensoryFrame frame;
  frame.insert(observation);
  frame.insert(toObservation(smallScan()));
  return bytesOf(frame);
}

// MRPT 2.15's own class has no fields of uint32: called with 0, the first is chosen where there are such fields.
template <typename Map>
auto addNumbers(Map& map, int) -> decltype(map.registerField_uint32(""), void())
{
  map.registerField_uint32("number");
}
template <typename Map>
void addNumbers(Map& map, long)
{
  map.registerField_uint16("number");
}

std::vector<Buffer> soundObjects()
{
  const auto imu = toObservation(ImuSample{smallScan().start, {1, 2, 3}, {4, 5, 6}}, {});
  auto numbered = mrpt::maps::CGenericPointsMap::Create();
  addNumbers(*numbered, 0);
  auto external = toObservation(Scan{});
  external->setAsExternalStorage("a.bin", mrpt::obs::CObservationPointCloud::ExternalStorageFormat::KittiBinFile);
  return {bytesOf(*toObservation(twoLidars(), smallScan().start)),
          bytesOf(*imu),
          bytesOf(*toObservation(smallScan())),
          bytesOf(*toObservation(smallScan(), CloudClass::CPointsMapXYZI)),
          bytesOf(*cloudOf(numbered)),
          bytesOf(*cloudOf(mrpt::maps::CSimplePointsMap::Create())),
          bytesOf(*cloudOf(mrpt::maps::CColouredPointsMap::Create())),
          bytesOf(*cloudOf(mrpt::maps::CWeightedPointsMap::Create())),
          bytesOf(*external),
          bytesOf(mrpt::obs::CObservationRobotPose()),
          bytesOf(mrpt::obs::CObservationOdometry()),
          frameOf(imu),
          actions()};
}

/** Each four bytes of the input change one of the object: where (16 bits), how, by what. */
Buffer changed(Buffer object, Bytes input)
{
  for (std::size_t at = 0; at + 4 <= input.size() && !object.empty(); at += 4)
  {
    const std::size_t place = load<std::uint16_t>(input, at) % object.size();
    const std::uint8_t value = input[at + 3];
    const auto here = object.begin() + static_cast<std::ptrdiff_t>(place);
    switch (input[at + 2] % 5)
    {
      case 0:
        *here = value;
        break;
      case 1:
        *here = static_cast<std::uint8_t>(*here ^ 1U << value % 8);
        break;
      case 2:
        std::fill(here, here + static_cast<std::ptrdiff_t>(std::min<std::size_t>(8, object.size() - place)), value);
        break;
      case 3:
        object.insert(here, value % 16, value);
        break;
      case 4:
        object.erase(here, here + static_cast<std::ptrdiff_t>(std::min<std::size_t>(value, object.size() - place)));
        break;
    }
  }
  return object;
}

/** The object's name, and the input as its version and all that follows. */
Buffer replaced(Buffer object, Bytes input)
{
  object.resize(kName + (object[0] & 0x7FU));
  for (std::size_t i = 0; i < input.size(); ++i) object.push_back(input[i]);
  return object;
}

void requireSound(const Scan& scan)
{
  std::size_t next = 0;
  for (const Column& column : scan.columns)
  {
    require(column.first_point == next && column.sensor_id < scan.columns_of.size());
    next += column.count;
  }
  require(next == scan.points.size());
  for (std::size_t i = 0; i < next; ++i) require(scan.points.position(i).allFinite());
}

void readEvents(const std::filesystem::path& rawlog)
{
  RawlogReader reader(rawlog);
  while (const auto event = reader.next())
  {
    if (const auto* scan = std::get_if<RecordedScan>(&*event)) requireSound(scan->scan);
    if (const auto* imu = std::get_if<RecordedImu>(&*event))
      require(imu->sample.accel.allFinite() && imu->sample.gyro.allFinite());
  }
}

void readAsInput(const std::filesystem::path& rawlog)
{
  RawlogInput input(rawlog, {});
  while (const auto event = input.next())
    if (const auto* scan = std::get_if<Scan>(&*event)) requireSound(*scan);
}

void readSummary(const std::filesystem::path& rawlog)
{
  const RawlogInfo info = rawlogInfo(rawlog);
  require(info.observations() >= 1 && info.span() >= Duration{0});
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const MemoryFile memory;
  static const std::vector<Buffer> sound = (registerClasses(), soundObjects());
  if (size < 2) return 0;
  const Bytes input(data + 2, size - 2);
  const Buffer& object = sound[data[0] % sound.size()];
  const Buffer damaged = data[1] % 4 == 0 ? replaced(object, input) : changed(object, input);

  if (damaged.empty()) return 0;  // MRPT refuses to write nothing

  const std::filesystem::path rawlog = memory.holding(Buffer{});
  GzipArchive archive(rawlog, 1);
  for (const Buffer& each : {sound[0], sound[2], damaged, sound[1], sound[2]})
    archive.WriteBuffer(each.data(), each.size());
  archive.close();
  constexpr std::array kReaders{&readEvents, &readAsInput, &readSummary};
  mayThrow<std::invalid_argument>([&] { kReaders[data[1] / 4 % kReaders.size()](rawlog); });  // a damaged header
  return 0;
}
