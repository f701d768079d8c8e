/**
 * MRPT's point map with named fields. MRPT has it from 2.15.0 on. For an older MRPT this file defines a class of the
 * same name and wire format, with the part of the interface that we use, so that both read the same rawlogs.
 *
 * Reads versions 0 to 4 of the wire format and writes version 3, which MRPT reads from 2.15.3 on (2.15.0 to 2.15.2 have
 * no uint8 fields and refuse it). A map with uint32 fields is written as version 4, the only one that has them.
 */
#pragma once
#if __has_include(<mrpt/maps/CGenericPointsMap.h>)
#include <mrpt/maps/CGenericPointsMap.h>
#else
#include "mrpt/observations/internal/CPointsMapWithFields.h"

#include <mrpt/serialization/CSerializable.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mrpt::maps
{
/** Points with any number of fields of type float, double, uint16, uint8 or uint32, each as long as the map. */
class CGenericPointsMap : public CPointsMapWithFields
{
  DEFINE_SERIALIZABLE(CGenericPointsMap, mrpt::maps)

 public:
  template <typename T>
  using Fields = std::map<std::string, mrpt::aligned_std_vector<T> >;

  CGenericPointsMap() = default;
  CGenericPointsMap(const CGenericPointsMap& other) : CPointsMapWithFields() { copyFrom(other); }
  CGenericPointsMap& operator=(const CGenericPointsMap& other)
  {
    copyFrom(other);
    return *this;
  }

  /** Adds a field of zeros; throws std::exception if the name is used already. Returns true, as MRPT's does. */
  bool registerField_float(const std::string& name) { return registerIn(float_fields_, name); }
  bool registerField_double(const std::string& name) { return registerIn(double_fields_, name); }
  bool registerField_uint16(const std::string& name) { return registerIn(uint16_fields_, name); }
  bool registerField_uint8(const std::string& name) { return registerIn(uint8_fields_, name); }
  bool registerField_uint32(const std::string& name) { return registerIn(uint32_fields_, name); }

  bool hasPointField(const std::string& name) const;

  const Fields<float>& float_fields() const { return float_fields_; }
  const Fields<double>& double_fields() const { return double_fields_; }
  const Fields<std::uint16_t>& uint16_fields() const { return uint16_fields_; }
  const Fields<std::uint8_t>& uint8_fields() const { return uint8_fields_; }
  const Fields<std::uint32_t>& uint32_fields() const { return uint32_fields_; }

  /** The values of a field; null if there is no field of that name and type. */
  auto* getPointsBufferRef_float_field(const std::string& name) { return find(float_fields_, name); }
  auto* getPointsBufferRef_float_field(const std::string& name) const { return find(float_fields_, name); }
  auto* getPointsBufferRef_double_field(const std::string& name) { return find(double_fields_, name); }
  auto* getPointsBufferRef_double_field(const std::string& name) const { return find(double_fields_, name); }
  auto* getPointsBufferRef_uint16_field(const std::string& name) { return find(uint16_fields_, name); }
  auto* getPointsBufferRef_uint16_field(const std::string& name) const { return find(uint16_fields_, name); }
  auto* getPointsBufferRef_uint8_field(const std::string& name) { return find(uint8_fields_, name); }
  auto* getPointsBufferRef_uint8_field(const std::string& name) const { return find(uint8_fields_, name); }
  auto* getPointsBufferRef_uint32_field(const std::string& name) { return find(uint32_fields_, name); }
  auto* getPointsBufferRef_uint32_field(const std::string& name) const { return find(uint32_fields_, name); }

  void reserve(std::size_t length) override;
  void resize(std::size_t length) override;
  void setSize(std::size_t length) override;
  void insertPointFast(float x, float y, float z = 0) override;
  void getPointAllFieldsFast(std::size_t index, std::vector<float>& values) const override;
  void setPointAllFieldsFast(std::size_t index, const std::vector<float>& values) override;
  void loadFromRangeScan(const mrpt::obs::CObservation2DRangeScan&,
                         const std::optional<const mrpt::poses::CPose3D>& = std::nullopt) override;
  void loadFromRangeScan(const mrpt::obs::CObservation3DRangeScan&,
                         const std::optional<const mrpt::poses::CPose3D>& = std::nullopt) override;

 protected:
  void copyFieldsFrom(const CPointsMap&) override;
  void addFrom_classSpecific(const CPointsMap& other, std::size_t previous_points,
                             bool filter_out_points_at_zero) override;
  void internal_clear() override;
  void PLY_import_set_vertex_count(std::size_t count) override { setSize(count); }

 private:
  /** Calls visit(fields) for each type, in the order of the wire. */
  template <typename Self, typename Visitor>
  static void forEachType(Self& self, Visitor&& visit)
  {
    visit(self.float_fields_);
    visit(self.double_fields_);
    visit(self.uint16_fields_);
    visit(self.uint8_fields_);
    visit(self.uint32_fields_);
  }

  template <typename SomeFields>
  static auto find(SomeFields& fields, const std::string& name) -> decltype(&fields.begin()->second)
  {
    const auto found = fields.find(name);
    return found == fields.end() ? nullptr : &found->second;
  }

  /** Calls visit(values) for x, y, z and every field. */
  template <typename Visitor>
  void forEachColumn(Visitor&& visit)
  {
    for (auto* values : {&m_x, &m_y, &m_z}) visit(*values);
    forEachType(*this,
                [&](auto& fields)
                {
                  for (auto& [name, values] : fields) visit(values);
                });
  }

  template <typename T>
  bool registerIn(Fields<T>& fields, const std::string& name)
  {
    if (hasPointField(name)) THROW_EXCEPTION_FMT("Field '%s' already exists.", name.c_str());
    fields[name].resize(m_x.size());
    return true;
  }

  template <typename RangeScan>
  void appendRangeScan(const RangeScan&, const std::optional<const mrpt::poses::CPose3D>&);

  Fields<float> float_fields_;
  Fields<double> double_fields_;
  Fields<std::uint16_t> uint16_fields_;
  Fields<std::uint8_t> uint8_fields_;
  Fields<std::uint32_t> uint32_fields_;
};
}  // namespace mrpt::maps
#endif
