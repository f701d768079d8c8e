#include "mrpt/observations/PointSelection.h"

#include <stdexcept>

namespace scanloom
{
namespace
{
using mrpt::maps::CGenericPointsMap;
using mrpt::maps::CPointsMap;

// MRPT's class has fields of uint32 from 3.0 on (ours always has them), and MRPT 2.15 has no applyDeletionMask() any
// more. A call with 0 chooses the first overload if the class has that member, else the second.

template <typename Map, typename Visitor>
auto forEachUint32Field(const Map& from, Map& to, const std::string& without, Visitor&& visit, int)
    -> decltype(from.uint32_fields(), void())
{
  for (const auto& [name, values] : from.uint32_fields())
    if (name != without && (to.hasPointField(name) || to.registerField_uint32(name)))
      visit(values, *to.getPointsBufferRef_uint32_field(name));
}
template <typename Map, typename Visitor>
void forEachUint32Field(const Map&, Map&, const std::string&, Visitor&&, long)
{
}

template <typename Map>
auto removeMarked(Map& map, const Map&, const std::vector<bool>& marked, int)
    -> decltype(map.applyDeletionMask(marked), void())
{
  map.applyDeletionMask(marked);
}
template <typename Map>
void removeMarked(Map& map, const Map& whole, const std::vector<bool>& marked, long)
{
  map.clear();
  map.registerPointFieldsFrom(whole);
  const auto context = map.prepareForInsertPointsFrom(whole);
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (!marked[i]) map.insertPointFrom(i, context);
}

/** Calls visit(values of `from`, values of `to`) for each field of `from`. A field that `to` lacks is added to it. */
template <typename Visitor>
void forEachField(const CGenericPointsMap& from, CGenericPointsMap& to, const std::string& without, Visitor&& visit)
{
  const auto has = [&](const std::string& name) { return to.hasPointField(name); };
  for (const auto& [name, values] : from.float_fields())
    if (name != without && (has(name) || to.registerField_float(name)))
      visit(values, *to.getPointsBufferRef_float_field(name));
  for (const auto& [name, values] : from.double_fields())
    if (name != without && (has(name) || to.registerField_double(name)))
      visit(values, *to.getPointsBufferRef_double_field(name));
  for (const auto& [name, values] : from.uint16_fields())
    if (name != without && (has(name) || to.registerField_uint16(name)))
      visit(values, *to.getPointsBufferRef_uint16_field(name));
  for (const auto& [name, values] : from.uint8_fields())
    if (name != without && (has(name) || to.registerField_uint8(name)))
      visit(values, *to.getPointsBufferRef_uint8_field(name));
  forEachUint32Field(from, to, without, visit, 0);
}

CGenericPointsMap::Ptr emptyLike(const CGenericPointsMap& cloud, std::size_t size)
{
  auto map = CGenericPointsMap::Create();
  map->insertionOptions = cloud.insertionOptions;
  map->likelihoodOptions = cloud.likelihoodOptions;
  map->resize(size);
  return map;
}

void copyPosition(const CPointsMap& from, std::size_t i, CPointsMap& to, std::size_t k)
{
  float x = 0, y = 0, z = 0;
  from.getPointFast(i, x, y, z);
  to.setPointFast(k, x, y, z);
}
}  // namespace

CGenericPointsMap::Ptr selected(const CGenericPointsMap& cloud, const std::vector<std::uint32_t>& points,
                                const std::string& without)
{
  auto map = emptyLike(cloud, points.size());
  for (std::size_t k = 0; k < points.size(); ++k) copyPosition(cloud, points[k], *map, k);
  forEachField(cloud, *map, without,
               [&](const auto& from, auto& to)
               {
                 for (std::size_t k = 0; k < points.size(); ++k) to[k] = from[points[k]];
               });
  return map;
}

CGenericPointsMap::Ptr joined(const std::vector<CGenericPointsMap::Ptr>& parts)
{
  std::size_t size = 0;
  for (const auto& part : parts) size += part->size();
  auto map = emptyLike(*parts.at(0), size);
  std::size_t offset = 0;
  for (const auto& part : parts)
  {
    for (std::size_t i = 0; i < part->size(); ++i) copyPosition(*part, i, *map, offset + i);
    forEachField(*part, *map, "",
                 [&](const auto& from, auto& to)
                 {
                   for (std::size_t i = 0; i < from.size(); ++i) to[offset + i] = from[i];
                 });
    offset += part->size();
  }
  return map;
}

CPointsMap::Ptr kept(const CPointsMap::Ptr& cloud, const std::vector<std::uint8_t>& keep)
{
  if (keep.size() != cloud->size()) throw std::invalid_argument("kept: one mark per point");
  if (const auto generic = std::dynamic_pointer_cast<CGenericPointsMap>(cloud))
  {
    std::vector<std::uint32_t> points;
    for (std::size_t i = 0; i < keep.size(); ++i)
      if (keep[i]) points.push_back(static_cast<std::uint32_t>(i));
    return selected(*generic, points);
  }
  // Other classes have fields of floats and bytes; MRPT copies them as floats, without loss.
  std::vector<bool> deletion(keep.size());
  for (std::size_t i = 0; i < keep.size(); ++i) deletion[i] = keep[i] == 0;
  auto map = std::dynamic_pointer_cast<CPointsMap>(cloud->duplicateGetSmartPtr());
  removeMarked(*map, *cloud, deletion, 0);
  return map;
}
}  // namespace scanloom
