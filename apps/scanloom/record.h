#pragma once
#include "Arguments.h"
#include "Recording.h"
#include "Web.h"

#include <filesystem>
#include <string>
#include <vector>

namespace scanloom
{
struct RecordArguments
{
  ConfigurationArguments configuration;
  SceneArguments scene;
  RecordingArguments recording;
  WebArguments web;
  std::filesystem::path output;  // empty: beside the recording
  std::vector<std::string> lidars;
  double seconds = 0;  // live: 0 until it is interrupted
  bool overwrite = false;
  bool json = false;
  bool quiet = false;
};

/** Writes a rawlog; for `scanloom record` and `scanloom edit --from-pcap`. @return the exit status. */
int record(RecordArguments);
}  // namespace scanloom
