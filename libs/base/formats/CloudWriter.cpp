#include "base/formats/CloudWriter.h"

#include "base/core/ConfigError.h"
#include "base/formats/internal/LazFile.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace scanloom
{
struct CloudWriter::Format
{
  std::string ending;
  std::unique_ptr<CloudEncoding> (*encoding)(Timestamp origin, const Eigen::Vector3d& offset, const std::string& wkt);
  OutputFile::Convert finish = nullptr;  // of the encoded file
};

const std::vector<CloudWriter::Format>& CloudWriter::formats()
{
  static const std::vector<Format> formats{
      {".ply", plyEncoding}, {".pcd", pcdEncoding}, {".las", lasEncoding}, {".laz", lasEncoding, compressLas}};
  return formats;
}

const std::vector<std::string>& CloudWriter::endings()
{
  static const std::vector<std::string> endings = []
  {
    std::vector<std::string> all;
    for (const Format& format : formats()) all.push_back(format.ending);
    return all;
  }();
  return endings;
}

const CloudWriter::Format& CloudWriter::formatOf(const std::filesystem::path& path)
{
  const std::string ending = path.extension().string();
  if (ending == ".laz" && !hasLaszip())
    throw UsageError(
        fmt::format("{}: this scanloom was built without LASzip, which Debian has from release 13 on: "
                    "write a .las file",
                    path.string()));
  for (const Format& format : formats())
    if (format.ending == ending) return format;
  throw std::invalid_argument(
      fmt::format("{}: a cloud's file must end in one of {}", path.string(), fmt::join(endings(), ", ")));
}

CloudWriter::CloudWriter(const std::filesystem::path& path, const Eigen::Vector3d& offset, const std::string& wkt)
  : format_(formatOf(path)), file_(path), offset_(offset), wkt_(wkt)
{
}

void CloudWriter::begin(Timestamp origin)
{
  origin_ = origin;
  encoding_ = format_.encoding(origin, offset_, wkt_);
  file_.stream() << encoding_->header(0);
}

void CloudWriter::add(const PointCloud& points, Timestamp stamp, const Rigid& frame_T_points)
{
  if (!encoding_) begin(stamp);
  const Rigid file_T_points{frame_T_points.rotation, frame_T_points.translation - offset_};
  LittleEndianBuffer buffer;
  for (std::size_t i = 0; i < points.size(); ++i)
    encoding_->put(buffer, file_T_points * points.position(i).cast<double>().eval(),
                   stamp - origin_ + Duration{points.t[i]}, points, i);
  buffer.writeTo(file_.stream());
  size_ += points.size();
}

void CloudWriter::close()
{
  if (!encoding_) begin(Timestamp{});
  file_.stream().seekp(0);
  file_.stream() << encoding_->header(size_);
  if (format_.finish)
    file_.commitConverted(format_.finish);
  else
    file_.commit();
}
}  // namespace scanloom
