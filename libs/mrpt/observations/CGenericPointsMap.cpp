#include "mrpt/observations/CGenericPointsMap.h"

#if !__has_include(<mrpt/maps/CGenericPointsMap.h>)
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/aligned_serialization.h>
#include <mrpt/serialization/stl_serialization.h>

#include <algorithm>
#include <type_traits>

IMPLEMENTS_SERIALIZABLE(CGenericPointsMap, CPointsMap, mrpt::maps)

namespace mrpt::maps
{
using mrpt::serialization::CArchive;

namespace
{
/** Whether a version of the wire format has fields of the type; float and uint16 always. */
template <typename T>
bool hasFieldsOf(const CGenericPointsMap::Fields<T>&, std::uint8_t version)
{
  const int first = std::is_same_v<T, double> ? 1 : std::is_same_v<T, std::uint8_t> ? 2 : 4;
  return std::is_same_v<T, float> || std::is_same_v<T, std::uint16_t> || version >= first;
}

template <typename T>
void writeValues(CArchive& out, const mrpt::aligned_std_vector<T>& values)
{
  if (!values.empty()) out.WriteBufferFixEndianness(values.data(), values.size());
}

/** Memory grows with the data that arrives: a damaged count ends in an exception, not in a request for 50 GB. */
template <typename T>
void readValues(CArchive& in, std::size_t count, mrpt::aligned_std_vector<T>& values)
{
  constexpr std::size_t kChunk = 1 << 20;
  values.clear();
  while (values.size() < count)
  {
    const std::size_t done = values.size();
    const std::size_t chunk = std::min(kChunk, count - done);
    values.resize(done + chunk);
    in.ReadBufferFixEndianness(values.data() + done, chunk);
  }
}

std::string readName(CArchive& in)
{
  constexpr std::uint32_t kLongest = 255;  // of the names of fields and types
  const auto length = in.ReadAs<std::uint32_t>();
  ASSERT_LE_(length, kLongest);
  std::string name(length, '\0');
  if (length > 0) in.ReadBuffer(name.data(), length);
  return name;
}

/** Up to version 2 values were written by MRPT's operators for containers, which write some types' names first. */
template <typename T>
void readOldPreamble(CArchive& in)
{
  if constexpr (!std::is_same_v<T, float>)
  {
    ASSERT_EQUAL_(readName(in), std::string("std::vector"));
    ASSERT_EQUAL_(readName(in), std::string(mrpt::typemeta::TTypeName<T>::get().c_str()));
  }
}

template <typename T>
void readField(CArchive& in, std::uint8_t version, mrpt::aligned_std_vector<T>& values)
{
  if (version < 3) readOldPreamble<T>(in);
  readValues(in, in.ReadAs<std::uint32_t>(), values);
}

/** Version 1, which MRPT 2.15 writes, lacks disableDeletion. Older MRPTs themselves read version 0 alone. */
void readOptions(CArchive& in, CPointsMap::TInsertionOptions& o)
{
  const auto version = in.ReadAs<std::uint8_t>();
  if (version > 1) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  in >> o.minDistBetweenLaserPoints >> o.addToExistingPointsMap >> o.also_interpolate;
  if (version == 0) in >> o.disableDeletion;
  in >> o.fuseWithExisting >> o.isPlanarMap >> o.horizontalTolerance >> o.maxDistForInterpolatePoints >>
      o.insertInvalidPoints;
}
}  // namespace

std::uint8_t CGenericPointsMap::serializeGetVersion() const { return uint32_fields_.empty() ? 3 : 4; }

void CGenericPointsMap::serializeTo(CArchive& out) const
{
  out.WriteAs<std::uint32_t>(m_x.size());
  writeValues(out, m_x);
  writeValues(out, m_y);
  writeValues(out, m_z);
  forEachType(*this,
              [&](const auto& fields)
              {
                if (!hasFieldsOf(fields, serializeGetVersion())) return;
                out.WriteAs<std::uint32_t>(fields.size());
                for (const auto& [name, values] : fields)
                {
                  out << name;
                  out.WriteAs<std::uint32_t>(values.size());
                  writeValues(out, values);
                }
              });
  insertionOptions.writeToStream(out);
  likelihoodOptions.writeToStream(out);
}

void CGenericPointsMap::serializeFrom(CArchive& in, std::uint8_t version)
{
  if (version > 4) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);

  internal_clear();
  const auto points = in.ReadAs<std::uint32_t>();
  readValues(in, points, m_x);
  readValues(in, points, m_y);
  readValues(in, points, m_z);
  forEachType(*this,
              [&](auto& fields)
              {
                if (!hasFieldsOf(fields, version)) return;
                const auto count = in.ReadAs<std::uint32_t>();
                for (std::uint32_t i = 0; i < count; i++)
                {
                  const std::string name = readName(in);
                  readField(in, version, fields[name]);
                  ASSERT_EQUAL_(fields[name].size(), m_x.size());
                }
              });
  readOptions(in, insertionOptions);
  likelihoodOptions.readFromStream(in);
}

bool CGenericPointsMap::hasPointField(const std::string& name) const
{
  bool found = false;
  forEachType(*this, [&](const auto& fields) { found = found || fields.count(name) != 0; });
  return found;
}

void CGenericPointsMap::reserve(std::size_t length)
{
  forEachColumn([&](auto& values) { values.reserve(length); });
}

void CGenericPointsMap::resize(std::size_t length)
{
  forEachColumn([&](auto& values) { values.resize(length); });
  mark_as_modified();
}

void CGenericPointsMap::setSize(std::size_t length)
{
  resize(0);
  resize(length);
}

void CGenericPointsMap::insertPointFast(float x, float y, float z)
{
  m_x.push_back(x);
  m_y.push_back(y);
  m_z.push_back(z);
  forEachType(*this,
              [&](auto& fields)
              {
                for (auto& [name, values] : fields) values.push_back(0);
              });
}

void CGenericPointsMap::getPointAllFieldsFast(std::size_t index, std::vector<float>& values) const
{
  values = {m_x[index], m_y[index], m_z[index]};
  forEachType(*this,
              [&](const auto& fields)
              {
                for (const auto& [name, field] : fields) values.push_back(static_cast<float>(field[index]));
              });
}

void CGenericPointsMap::setPointAllFieldsFast(std::size_t index, const std::vector<float>& values)
{
  setPointFast(index, values.at(0), values.at(1), values.at(2));
  std::size_t next = 3;
  forEachType(*this,
              [&](auto& fields)
              {
                for (auto& [name, field] : fields)
                  field[index] = static_cast<std::decay_t<decltype(field[index])>>(values.at(next++));
              });
}

void CGenericPointsMap::copyFieldsFrom(const CPointsMap& other)
{
  const auto* generic = dynamic_cast<const CGenericPointsMap*>(&other);
  if (!generic) return;
  float_fields_ = generic->float_fields_;
  double_fields_ = generic->double_fields_;
  uint16_fields_ = generic->uint16_fields_;
  uint8_fields_ = generic->uint8_fields_;
  uint32_fields_ = generic->uint32_fields_;
}

void CGenericPointsMap::addFrom_classSpecific(const CPointsMap& other, std::size_t previous_points,
                                              bool filter_out_points_at_zero)
{
  const auto* generic = dynamic_cast<const CGenericPointsMap*>(&other);
  if (!generic) return;

  std::vector<std::size_t> kept;
  kept.reserve(generic->size());
  for (std::size_t i = 0; i < generic->size(); i++)
    if (!filter_out_points_at_zero || generic->m_x[i] != 0 || generic->m_y[i] != 0 || generic->m_z[i] != 0)
      kept.push_back(i);

  const auto copyCommon = [&](const auto& from, auto& to)
  {
    for (auto& [name, values] : to)
      if (const auto* source = find(from, name))
        for (std::size_t k = 0; k < kept.size(); k++) values[previous_points + k] = (*source)[kept[k]];
  };
  copyCommon(generic->float_fields_, float_fields_);
  copyCommon(generic->double_fields_, double_fields_);
  copyCommon(generic->uint16_fields_, uint16_fields_);
  copyCommon(generic->uint8_fields_, uint8_fields_);
  copyCommon(generic->uint32_fields_, uint32_fields_);
}

void CGenericPointsMap::internal_clear()
{
  resize(0);
  forEachType(*this, [](auto& fields) { fields.clear(); });
}

void CGenericPointsMap::loadFromRangeScan(const mrpt::obs::CObservation2DRangeScan& scan,
                                          const std::optional<const mrpt::poses::CPose3D>& pose)
{
  appendRangeScan(scan, pose);
}

void CGenericPointsMap::loadFromRangeScan(const mrpt::obs::CObservation3DRangeScan& scan,
                                          const std::optional<const mrpt::poses::CPose3D>& pose)
{
  appendRangeScan(scan, pose);
}

template <typename RangeScan>
void CGenericPointsMap::appendRangeScan(const RangeScan& scan, const std::optional<const mrpt::poses::CPose3D>& pose)
{
  CSimplePointsMap points;
  points.insertionOptions = insertionOptions;
  points.loadFromRangeScan(scan, pose);
  if (!insertionOptions.addToExistingPointsMap) resize(0);
  insertAnotherMap(&points, mrpt::poses::CPose3D::Identity());
}
}  // namespace mrpt::maps
#endif
