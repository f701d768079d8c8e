/**
 * mrpt::maps::CPointsMap for a class with fields of its own. Up to 2.13.1 MRPT asks the class for its fields when a map
 * is copied or added to another. Since 2.13.2 it does not, and copies points by itself: here the class is asked still.
 */
#pragma once
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/version.h>

namespace mrpt::maps
{
class CPointsMapWithFields : public CPointsMap
{
 protected:
  /** Takes the fields of a map of the same class; of another class nothing. The points are copied next. */
  virtual void copyFieldsFrom(const CPointsMap&) = 0;

#if MRPT_VERSION < 0x20d02
  void impl_copyFrom(const CPointsMap& other) override { copyFrom(other); }

  void copyFrom(const CPointsMap& other)
  {
    if (this == &other) return;
    copyFieldsFrom(other);
    base_copyFrom(other);
  }
#else
  void copyFrom(const CPointsMap& other)
  {
    if (this == &other) return;
    copyFieldsFrom(other);
    m_x = other.getPointsBufferRef_x();
    m_y = other.getPointsBufferRef_y();
    m_z = other.getPointsBufferRef_z();
    resize(m_x.size());
  }

 public:
  /** Hides MRPT's, which is not virtual: called by way of a CPointsMap, fields of the new points are 0. */
  void insertAnotherMap(const CPointsMap* other, const mrpt::poses::CPose3D& pose,
                        bool filter_out_points_at_zero = false)
  {
    const std::size_t previous_points = size();
    CPointsMap::insertAnotherMap(other, pose, filter_out_points_at_zero);
    addFrom_classSpecific(*other, previous_points, filter_out_points_at_zero);
  }
#endif
};
}  // namespace mrpt::maps
