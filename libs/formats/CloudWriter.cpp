#include "formats/CloudWriter.h"

#include "core/ConfigError.h"
#include "formats/LazFile.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace scanloom
{
const std::vector<std::string>& CloudWriter::endings()
{
  static const std::vector<std::string> endings{".ply", ".pcd", ".las", ".laz"};
  return endings;
}

CloudWriter::MakeEncoding CloudWriter::encodingOf(const std::filesystem::path& path)
{
  const auto ending = path.extension();
  if (ending == ".ply") return plyEncoding;
  if (ending == ".pcd") return pcdEncoding;
  if (ending == ".las") return lasEncoding;
  if (ending == ".laz" && !hasLaszip())
    throw UsageError(
        fmt::format("{}: this scanloom was built without LASzip, which Debian has from release 13 on: "
                    "write a .las file",
                    path.string()));
  if (ending == ".laz") return lasEncoding;
  throw std::invalid_argument(
      fmt::format("{}: a cloud's file must end in one of {}", path.string(), fmt::join(endings(), ", ")));
}

CloudWriter::CloudWriter(const std::filesystem::path& path)
  : make_encoding_(encodingOf(path)), is_laz_(path.extension() == ".laz"), file_(path)
{
}

void CloudWriter::begin(Timestamp origin)
{
  origin_ = origin;
  encoding_ = make_encoding_(origin);
  file_.stream() << encoding_->header(0);
}

void CloudWriter::add(const PointCloud& points, Timestamp stamp, const Rigid& frame_T_points)
{
  if (!encoding_) begin(stamp);
  LittleEndianBuffer buffer;
  for (std::size_t i = 0; i < points.size(); ++i)
    encoding_->put(buffer, frame_T_points * points.position(i).cast<double>().eval(),
                   stamp - origin_ + Duration{points.t[i]}, points, i);
  buffer.writeTo(file_.stream());
  size_ += points.size();
}

void CloudWriter::close()
{
  if (!encoding_) begin(Timestamp{});
  file_.stream().seekp(0);
  file_.stream() << encoding_->header(size_);
  if (is_laz_)
    file_.commitConverted(compressLas);
  else
    file_.commit();
}
}  // namespace scanloom
