#include "mrpt/observations/RawlogWriter.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/observations/GzipArchive.h"
#include "mrpt/observations/Observations.h"
#include "mrpt/observations/readByAll.h"

#include <utility>

namespace scanloom
{
RawlogWriter::RawlogWriter(const std::filesystem::path& path, RecordingHeader header, const RawlogOptions& options)
  : file_(path, Uncommitted::Stays),
    options_(options),
    header_(std::move(header)),
    archive_(std::make_unique<GzipArchive>(file_.descriptor(), file_.temporary(), options.compression_level))
{
}

RawlogWriter::~RawlogWriter() = default;

void RawlogWriter::write(const mrpt::obs::CObservation& observation)
{
  writeHeaderOnce(fromMrpt(observation.timestamp));
  writeForAll(observation, *archive_);
  unsecured_ = true;
  secure();
}

void RawlogWriter::secure()
{
  const auto now = std::chrono::steady_clock::now();
  if (options_.safe_every == 0s || !unsecured_ || now - secured_ < options_.safe_every) return;
  archive_->endMember();
  secured_ = now;
  unsecured_ = false;
}

std::filesystem::path RawlogWriter::close(Completeness completeness)
{
  writeHeaderOnce(fromNanoseconds(0));
  archive_->close();
  archive_.reset();
  return file_.commit(completeness);
}

void RawlogWriter::writeHeaderOnce(Timestamp stamp)
{
  if (!header_) return;
  *archive_ << *toObservation(*header_, stamp);
  header_.reset();
}
}  // namespace scanloom
