#include "input/rawlogs/CountedArchive.h"

#include <fmt/format.h>
#include <mrpt/version.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace scanloom
{
namespace
{
constexpr const char* kMap = "CSimpleMap";
constexpr const char* kFrame = "CSensoryFrame";
constexpr const char* kActions = "CActionCollection";
constexpr const char* kMovement = "CActionRobotMovement2D";
constexpr const char* kMovement3d = "CActionRobotMovement3D";

constexpr const char* kGeneric = "CGenericPointsMap";
constexpr const char* kRotatingScan = "CObservationRotatingScan";

/** Since MRPT 2.15 the class is MRPT's own; before it is ours, which reads in pieces and takes no memory in advance. */
constexpr int kArraysOfGeneric = MRPT_VERSION < 0x20f00 ? 0 : 3;

constexpr std::uint64_t kFloat = 4;  // bytes, of an item of a later count: one colour of a point
constexpr int kEach = std::numeric_limits<int>::max();

// The shortest object is a null pointer: 9 bytes. A point takes a float for each field.
constexpr std::array kCountedClasses{
    CountedClass{kMap, 18},
    CountedClass{kFrame, 9},
    CountedClass{kActions, 9},
    CountedClass{kMovement, 1, 0, 0, 4},
    CountedClass{kMovement3d, 1, 0, kEach},               // its first number is not large
    CountedClass{"CObservationPointCloud", 1, 1, kEach},  // its label, and a file's name
    CountedClass{"CObservationComment", 1, 1, kEach},
    CountedClass{"CObservationVelodyneScan", 1, 1, kEach, 0, 1206},  // its label, its packets
    CountedClass{kRotatingScan, 1},
    CountedClass{"CObservationIMU", 8, 1, kEach},  // before version 4: numbers of doubles
    CountedClass{"CObservationRobotPose", 1},
    CountedClass{"CObservationOdometry", 1},
    CountedClass{"CPose2D", 0, 0, 0, 1},
    CountedClass{"CPose3D", 0, 0, 0, 2},
    CountedClass{"CPose3DPDFGaussian", 0, 0, 0, 1},
    CountedClass{"CSimplePointsMap", 12},
    CountedClass{"CPointsMapXYZI", 16},
    CountedClass{"CPointsMapXYZIRT", 12},
    CountedClass{"CColouredPointsMap", 12, 3, 3, 8},  // three coordinates, three colours
    CountedClass{"CWeightedPointsMap", 12},
    CountedClass{kGeneric, 12, kArraysOfGeneric},
    CountedClass{"CPosePDFParticles", 32},
    CountedClass{"CPosePDFSOG", 32},
    CountedClass{"CPose3DPDFParticles", 56},
    CountedClass{"CPose3DPDFSOG", 56},
};

constexpr CountedClass kVelocity{"velocity", 1, 1, 1};  // of a keyframe, after its frame: names of two types

constexpr std::string_view kLists = "std::vector<uint64_t>";  // in a vector of them

constexpr std::size_t kLongestName = 120;  // as in MRPT

constexpr std::uint64_t kSmall = 1 << 20;  // bytes: memory for so many is no harm, if they follow or not

// An object is in memory twice while it is read, and rawlogs are packed to a quarter.
constexpr std::uint64_t kLargestObject = 64 << 20, kLargestRatio = 8;

/** Without its namespace, which old files do not have. A zero byte ends the name, as in MRPT. */
std::string_view bareName(std::string_view name)
{
  name = name.substr(0, name.find('\0'));
  if (const auto space = name.rfind("::"); space != std::string_view::npos) name.remove_prefix(space + 2);
  return name;
}

const CountedClass* classNamed(std::string_view text)
{
  if (text.size() > kLongestName) return nullptr;
  const std::string_view name = bareName(text);
  const auto found = std::find_if(kCountedClasses.begin(), kCountedClasses.end(),
                                  [&](const CountedClass& known) { return known.name == name; });
  return found == kCountedClasses.end() ? nullptr : &*found;
}
}  // namespace

CountedArchive::CountedArchive(const std::filesystem::path& path)
  : file_(path), largest_object_(kLargestObject + kLargestRatio * std::filesystem::file_size(path))
{
}

bool CountedArchive::atEnd()
{
  object_ = 0;
  within_.clear();
  next_ = Next::Anything;  // versions without a label have fewer counts than the class
  return ahead_taken_ == ahead_.size() && file_.atEnd();
}

std::size_t CountedArchive::read(void* bytes, std::size_t count)
{
  object_ += count;
  if (object_ > largest_object_) refuseLargeObject();
  const std::size_t known = std::min(count, ahead_.size() - ahead_taken_);
  std::copy_n(ahead_.begin() + static_cast<std::ptrdiff_t>(ahead_taken_), known, static_cast<char*>(bytes));
  ahead_taken_ += known;
  if (known < count) file_.read(static_cast<char*>(bytes) + known, count - known);
  followObjects(static_cast<const char*>(bytes), count);
  follow(static_cast<const char*>(bytes), count);
  return count;
}

std::size_t CountedArchive::write(const void*, std::size_t)
{
  throw std::logic_error("a CountedArchive is for reading");
}

void CountedArchive::follow(const char* bytes, std::size_t count)
{
  const Next now = next_;
  if (part_)
    next_ = std::exchange(part_, nullptr)->least_version <= static_cast<unsigned char>(bytes[0]) ? now : Next::Anything;
  else if (now == Next::Version)
    followVersion(static_cast<unsigned char>(bytes[0]));
  else if (now == Next::Movement)
    followMovement(bytes, count);
  else if (now == Next::Id && count == sizeof(std::uint32_t))
    next_ = Next::Count;
  else if (now == Next::Count && count == sizeof(std::uint32_t))
  {
    std::uint32_t items = 0;
    std::memcpy(&items, bytes, sizeof items);
    followCount(items);
  }
  else if (now == Next::Fields)
    followFields(bytes, count);
  else if (now == Next::Items && std::string_view(bytes, count) == kLists)
    next_ = Next::NoLists;
  else if (now == Next::NoLists)
    followLists(bytes, count);
  else if (now == Next::Items)
    next_ = --arrays_ > 0 ? Next::Items : afterItems();
  else if (const CountedClass* begun = classNamed({bytes, count}))
    begin(*begun);
  else if (now == Next::Images)
    followImages(bytes, count);
}

/** Of its name and, as the last, its values. Up to version 2 the names of two types are between, but for floats. */
int CountedArchive::countsPerField() const
{
  constexpr int kFloats = 1;  // the first type
  return version_ < 3 && field_types_ > kFloats ? 4 : 2;
}

/** For each type of values the number of its fields, and for each of these its counts. */
void CountedArchive::followFields(const char* bytes, std::size_t count)
{
  next_ = Next::Anything;
  if (count != sizeof(std::uint32_t)) return;  // the options begin with one byte
  constexpr std::uint32_t kMostFields = 1 << 16;
  std::uint32_t fields = 0;
  std::memcpy(&fields, bytes, count);
  if (fields > kMostFields) refuse(fmt::format("is damaged: a {} of {} fields", class_->name, fields));
  ++field_types_;
  more_ = static_cast<int>(fields) * countsPerField();
  next_ = afterItems();
}

/** Each list would have counts of its own. No stock program writes them. */
void CountedArchive::followLists(const char* bytes, std::size_t count)
{
  if (std::any_of(bytes, bytes + count, [](char byte) { return byte != 0; }))
    refuse(fmt::format("holds a {} with lists of points by laser, which are not read", class_->name));
  next_ = Next::Anything;
}

/**
 * In a CObservationRotatingScan, whose counts have no fixed order: numbers of two bytes, one behind the other, are the
 * width and the height of an image, and in its first version those of four bytes the length of a name.
 */
void CountedArchive::followImages(const char* bytes, std::size_t count)
{
  std::uint32_t number = 0;
  if (count <= sizeof number) std::memcpy(&number, bytes, count);
  if (count == sizeof number && version_ == 0) requireToFollow(number, "characters");
  if (count != sizeof(std::uint16_t))
  {
    numbers_.clear();
    return;
  }
  numbers_.push_back(number);
  if (numbers_.size() >= 2) requireToFollow(std::uint64_t{numbers_[numbers_.size() - 2]} * number, "pixels");
}

/** MRPT writes the length of the name with the highest bit set, the name, the data, and an end flag. */
void CountedArchive::followObjects(const char* bytes, std::size_t count)
{
  constexpr unsigned kEndFlag = 0x88, kLengthBit = 0x80;
  if (name_length_ > 0 && count == name_length_)
  {
    const std::string name(bareName({bytes, count}));
    if (!within_.empty() && within_.back() == kActions && name != kMovement && name != kMovement3d)
      refuse(fmt::format("is damaged: an action of class '{}'", name));
    within_.push_back(name);
    if (next_ == Next::Count && !classNamed(name)) next_ = Next::Anything;
  }
  name_length_ = 0;
  if (count != 1) return;
  const unsigned byte = static_cast<unsigned char>(bytes[0]);
  if (byte == kEndFlag && !within_.empty())
  {
    const bool is_frame = within_.back() == kFrame;
    within_.pop_back();
    if (is_frame && has_velocities_ && !within_.empty() && within_.back() == kMap) beginVelocity();
  }
  else if ((byte & kLengthBit) != 0)
    name_length_ = byte & ~kLengthBit;
}

void CountedArchive::begin(const CountedClass& begun)
{
  if (begun.least_bytes == 0)
  {
    part_ = &begun;
    return;
  }
  class_ = &begun;
  arrays_ = begun.arrays;
  more_ = begun.more;
  field_types_ = 0;
  next_ = Next::Version;
}

void CountedArchive::beginVelocity()
{
  begin(kVelocity);
  next_ = Next::Count;
}

void CountedArchive::followVersion(unsigned version)
{
  // MRPT would take any object there as a 2D pose, without a check.
  if (class_->name == kMap && version == 0) refuse("is of 2D poses (version 0), or damaged");
  version_ = version;
  if (class_->name == kMap) has_velocities_ = version >= 2;
  if (version < class_->least_version)
    refuse(
        fmt::format("holds a {} of version {}: {} or later can be read", class_->name, version, class_->least_version));
  numbers_.clear();
  next_ = class_->name == kMovement               ? Next::Movement
          : class_->name == kRotatingScan         ? Next::Images
          : class_->name == kFrame && version < 2 ? Next::Id
                                                  : Next::Count;
}

void CountedArchive::followMovement(const char* bytes, std::size_t count)
{
  // Version 4 and later: how it was estimated (0: by odometry); then a pose with its distribution, or for odometry the
  // model, six floats, and the number of particles that MRPT draws.
  constexpr std::size_t kParticles = 8;
  constexpr std::uint32_t kMostParticles = 100'000;
  constexpr std::array kPoses{"CPosePDFGaussian", "CPosePDFGaussianInf", "CPosePDFParticles", "CPosePDFSOG"};
  if (count == sizeof(std::uint32_t))
  {
    std::memcpy(&numbers_.emplace_back(), bytes, count);
    if (numbers_[0] != 0 || numbers_.size() <= kParticles) return;
    if (numbers_[kParticles] > kMostParticles)
      refuse(fmt::format("is damaged: a {} of {} particles", kMovement, numbers_[kParticles]));
    next_ = Next::Anything;
    return;
  }
  const bool before_pose = numbers_.size() == 1 && numbers_[0] != 0 && count > 1;
  if (!before_pose) return;
  const std::string_view name = bareName({bytes, count});
  if (std::find(kPoses.begin(), kPoses.end(), name) == kPoses.end())
    refuse(fmt::format("is damaged: a {} without a pose", kMovement));
  next_ = Next::Anything;
  if (const CountedClass* begun = classNamed(name)) begin(*begun);
}

void CountedArchive::followCount(std::uint32_t items)
{
  if (field_types_ == 0)
    points_ = items;
  else if (more_ % countsPerField() == 0 && items != points_)
    refuse(fmt::format("is damaged: a {} of {} points, but {} values of a field", class_->name, points_, items));
  const int counts_before = class_->more - more_;
  const std::uint64_t least = field_types_ > 0                                 ? 1
                              : counts_before == 0                             ? class_->least_bytes
                              : counts_before == 1 && class_->second_bytes > 0 ? class_->second_bytes
                                                                               : std::min(class_->least_bytes, kFloat);
  requireToFollow(items, "items", least);
  next_ = items > 0 && arrays_ > 0 ? Next::Items : afterItems();
}

CountedArchive::Next CountedArchive::afterItems()
{
  arrays_ = 1;
  if (more_-- > 0) return Next::Count;
  return class_->name == kGeneric && kArraysOfGeneric > 0 ? Next::Fields : Next::Anything;
}

void CountedArchive::requireToFollow(std::uint64_t items, const char* what, std::uint64_t least_bytes)
{
  if (!follows(items * least_bytes))
    refuse(
        fmt::format("is damaged: a {} of {} {}, but only {} bytes follow", class_->name, items, what, ahead_.size()));
}

bool CountedArchive::follows(std::uint64_t bytes)
{
  if (bytes <= kSmall) return true;
  ahead_.erase(ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(ahead_taken_));
  ahead_taken_ = 0;
  while (ahead_.size() < bytes)
  {
    if (object_ + ahead_.size() > largest_object_) refuseLargeObject();
    const std::size_t before = ahead_.size();
    ahead_.resize(before + kSmall);
    ahead_.resize(before + file_.readUpTo(ahead_.data() + before, kSmall));
    if (ahead_.size() == before) return false;
  }
  return true;
}

void CountedArchive::refuseLargeObject()
{
  refuse(fmt::format("an object of more than {} MB, too large for a file of this size", largest_object_ >> 20));
}

void CountedArchive::refuse(const std::string& why)
{
  refused_ = why;
  throw std::runtime_error(why);
}
}  // namespace scanloom
