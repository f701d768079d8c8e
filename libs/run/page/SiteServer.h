#pragma once
#include "run/page/internal/HttpServer.h"
#include "run/page/internal/PageFiles.h"

#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
/** What site.json names. */
struct SiteIndex
{
  std::vector<std::string> drives, tiles;  // without the endings of their files
  double tile_edge = 0;                    // m
};

/**
 * Shows a folder that `site` wrote: drives, loops, references, what is gone, and its tiles. A request names a file of
 * the site by its number in site.json, never by a path.
 *
 *     GET /                  the page and its files
 *     GET /site.json         also loops.csv, references.csv (where there are any) and gone.csv
 *     GET /drive?number=N    poses of a drive, as .tum
 *     GET /tile?number=N     occupied voxels: x, y, z of an origin (m) as doubles, then cm from it as int16
 */
class SiteServer
{
 public:
  /** Throws std::runtime_error if it is no site, and what readPage() and HttpServer throw. */
  SiteServer(const SensorAddress&, const std::filesystem::path& site);

  /** "http://127.0.0.1:8080" */
  std::string url() const { return server_.url(); }

 private:
  void answer(const HttpRequest&, HttpReply&) const;

  std::filesystem::path folder_;
  SiteIndex index_;
  PageFiles files_;
  HttpServer server_;  // last: its threads use all of the above
};

/** Whether `site` wrote the folder. */
bool isSite(const std::filesystem::path& folder);
}  // namespace scanloom
