#include "maps/SimpleMapArchive.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace scanloom
{
namespace
{
constexpr const char* kMap = "CSimpleMap";
constexpr const char* kFrame = "CSensoryFrame";
constexpr const char* kCloudObservation = "CObservationPointCloud";

// The shortest object is a null pointer: 9 bytes. A point takes a float for each field.
constexpr std::array kCountedClasses{
    CountedClass{kMap, 18},
    CountedClass{kFrame, 9},
    CountedClass{kCloudObservation, 1},  // its label, and later a file's name
    CountedClass{"CSimplePointsMap", 12},
    CountedClass{"CPointsMapXYZI", 16},
    CountedClass{"CPointsMapXYZIRT", 12},
    CountedClass{"CColouredPointsMap", 12},
    CountedClass{"CWeightedPointsMap", 12},
    CountedClass{"CGenericPointsMap", 12},
    CountedClass{"CPose3DPDFParticles", 56},
    CountedClass{"CPose3DPDFSOG", 56},
};

/** With or without its namespace (old files have none). A zero byte ends the name, as in MRPT. */
const CountedClass* classNamed(std::string_view name)
{
  name = name.substr(0, name.find('\0'));
  if (const auto space = name.rfind("::"); space != std::string_view::npos) name.remove_prefix(space + 2);
  const auto found = std::find_if(kCountedClasses.begin(), kCountedClasses.end(),
                                  [&](const CountedClass& known) { return known.name == name; });
  return found == kCountedClasses.end() ? nullptr : &*found;
}
}  // namespace

SimpleMapArchive::SimpleMapArchive(const std::filesystem::path& path)
  : file_(GzipArchive::reading(path)), left_(GzipArchive::uncompressedBytes(path))
{
}

std::size_t SimpleMapArchive::read(void* bytes, std::size_t count)
{
  file_.ReadBuffer(bytes, count);
  left_ -= count;
  follow(static_cast<const char*>(bytes), count);
  return count;
}

std::size_t SimpleMapArchive::write(const void*, std::size_t)
{
  throw std::logic_error("a SimpleMapArchive is for reading");
}

void SimpleMapArchive::follow(const char* bytes, std::size_t count)
{
  const Next now = next_;
  if (now == Next::Version)
    followVersion(bytes[0]);
  else if (now == Next::Id && count == sizeof(std::uint32_t))
    next_ = Next::Count;
  else if (now == Next::Count && count == sizeof(std::uint32_t))
  {
    std::uint32_t items = 0;
    std::memcpy(&items, bytes, sizeof items);
    requireFits(items);
    next_ = class_->name != kCloudObservation ? Next::Anything : items > 0 ? Next::Text : Next::Count;
  }
  else if (now == Next::Text)
    next_ = Next::Count;
  else if (const CountedClass* begun = classNamed({bytes, count}))
  {
    class_ = begun;
    next_ = Next::Version;
  }
}

void SimpleMapArchive::followVersion(char version)
{
  // MRPT would take any object there as a 2D pose, without a check.
  if (class_->name == kMap && version == 0) refuse("is of 2D poses (version 0), or damaged");
  next_ = class_->name == kFrame && version < 2 ? Next::Id : Next::Count;
}

void SimpleMapArchive::requireFits(std::uint64_t items)
{
  if (items * class_->least_bytes > left_)
    refuse(fmt::format("is damaged: a {} of {} items, but only {} bytes follow", class_->name, items, left_));
}

void SimpleMapArchive::refuse(const std::string& why)
{
  refused_ = why;
  throw std::runtime_error(why);
}
}  // namespace scanloom
