/**
 * Objects of MRPT's classes that are written in the version that every MRPT from 2.5 on reads. A reader does not see
 * the difference: name and content are the same.
 */
#pragma once
#include "mrpt/observations/internal/XyziReadByAll.h"

#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/serialization/CArchive.h>

namespace scanloom
{
/** Since 2.11.12 MRPT writes version 1, which adds the label. */
class CommentReadByAll : public mrpt::obs::CObservationComment
{
 public:
  CommentReadByAll() = default;
  explicit CommentReadByAll(const CObservationComment& comment) : CObservationComment(comment) {}

 protected:
  std::uint8_t serializeGetVersion() const override { return 0; }
  void serializeTo(mrpt::serialization::CArchive& out) const override { out << text << timestamp; }
};

/** The observation with a cloud that every MRPT reads, if its cloud is one that MRPT writes for newer ones only. */
inline mrpt::obs::CObservationPointCloud::Ptr withXyziReadByAll(
    [[maybe_unused]] const mrpt::obs::CObservation& observation)
{
#if SCANLOOM_HAS_XYZI
  const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation);
  const auto* points = cloud ? dynamic_cast<const mrpt::maps::CPointsMapXYZI*>(cloud->pointcloud.get()) : nullptr;
  if (points && !dynamic_cast<const XyziReadByAll*>(points))
  {
    auto rewritten = std::make_shared<mrpt::obs::CObservationPointCloud>(*cloud);
    rewritten->pointcloud = std::make_shared<XyziReadByAll>(*points);
    return rewritten;
  }
#endif
  return nullptr;
}

inline void writeForAll(const mrpt::obs::CObservation& observation, mrpt::serialization::CArchive& out)
{
  if (const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(&observation))
    out << CommentReadByAll(*comment);
  else if (const auto cloud = withXyziReadByAll(observation))
    out << *cloud;
  else
    out << observation;
}
}  // namespace scanloom
