/**
 * MRPT 2's class of points with an intensity, written as every MRPT 2 reads it. Since 2.15.3 MRPT itself writes the
 * options of insertion as version 1, without disableDeletion, which older MRPTs refuse. MRPT 3 has no such class.
 */
#pragma once
#if __has_include(<mrpt/maps/CPointsMapXYZI.h>)
#define SCANLOOM_HAS_XYZI 1
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/serialization/CArchive.h>

namespace scanloom
{
class XyziReadByAll : public mrpt::maps::CPointsMapXYZI
{
 public:
  XyziReadByAll() = default;

  explicit XyziReadByAll(const mrpt::maps::CPointsMapXYZI& other)
  {
    insertionOptions = other.insertionOptions;
    likelihoodOptions = other.likelihoodOptions;
    m_x = other.getPointsBufferRef_x();
    m_y = other.getPointsBufferRef_y();
    m_z = other.getPointsBufferRef_z();
    resize(m_x.size());
    for (std::size_t i = 0; i < m_x.size(); ++i) m_intensity[i] = other.getPointIntensity_fast(i);
  }

 protected:
  std::uint8_t serializeGetVersion() const override { return 0; }
  void serializeTo(mrpt::serialization::CArchive& out) const override
  {
    out.WriteAs<std::uint32_t>(m_x.size());
    for (const auto* values : {&m_x, &m_y, &m_z, &m_intensity})
      if (!values->empty()) out.WriteBufferFixEndianness(values->data(), values->size());
    const auto& o = insertionOptions;
    constexpr bool kDisableDeletion = true;  // MRPT's default; what reads the file does not insert points
    out.WriteAs<std::int8_t>(0);
    out << o.minDistBetweenLaserPoints << o.addToExistingPointsMap << o.also_interpolate << kDisableDeletion
        << o.fuseWithExisting << o.isPlanarMap << o.horizontalTolerance << o.maxDistForInterpolatePoints
        << o.insertInvalidPoints;
    likelihoodOptions.writeToStream(out);
  }
};
}  // namespace scanloom
#endif
