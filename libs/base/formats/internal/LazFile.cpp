#include "base/formats/internal/LazFile.h"

#include <fmt/format.h>

#include <stdexcept>

#ifdef SCANLOOM_LASZIP
#include <laszip_api.h>
#endif

namespace scanloom
{
#ifdef SCANLOOM_LASZIP
namespace
{
/** A reader or a writer of LASzip. */
class Laszip
{
 public:
  explicit Laszip(std::filesystem::path file) : file_(std::move(file))
  {
    if (laszip_create(&handle_) != 0) throw std::runtime_error("LASzip cannot be used");
  }
  Laszip(const Laszip&) = delete;
  Laszip& operator=(const Laszip&) = delete;
  ~Laszip() { laszip_destroy(handle_); }

  template <typename Function, typename... Arguments>
  void call(Function&& function, Arguments... arguments)
  {
    if (function(handle_, arguments...) == 0) return;
    char* reason = nullptr;
    laszip_get_error(handle_, &reason);
    throw std::runtime_error(fmt::format("{}: LASzip: {}", file_.string(), reason ? reason : "no reason given"));
  }

  const char* file() const { return file_.c_str(); }

 private:
  std::filesystem::path file_;
  laszip_POINTER handle_ = nullptr;
};
}  // namespace

bool hasLaszip() { return true; }

void compressLas(const std::filesystem::path& las, const std::filesystem::path& laz)
{
  Laszip reader(las), writer(laz);
  laszip_BOOL is_compressed = 0;
  reader.call(laszip_open_reader, reader.file(), &is_compressed);
  laszip_header_struct* header = nullptr;
  laszip_point_struct* point = nullptr;
  reader.call(laszip_get_header_pointer, &header);
  reader.call(laszip_get_point_pointer, &point);

  constexpr laszip_BOOL kYes = 1;
  writer.call(laszip_set_header, header);
  writer.call(laszip_preserve_generating_software, kYes);
  writer.call(laszip_request_native_extension, kYes);  // formats from 6 on as they are, not as one of LAS 1.2
  writer.call(laszip_open_writer, writer.file(), kYes);
  for (laszip_U64 i = 0; i < header->extended_number_of_point_records; ++i)
  {
    reader.call(laszip_read_point);
    writer.call(laszip_set_point, point);
    writer.call(laszip_write_point);
  }
  writer.call(laszip_close_writer);
  reader.call(laszip_close_reader);
}
#else
bool hasLaszip() { return false; }

void compressLas(const std::filesystem::path&, const std::filesystem::path& laz)
{
  throw std::runtime_error(fmt::format("{}: LAZ needs LASzip, which this scanloom was built without", laz.string()));
}
#endif
}  // namespace scanloom
