/** The options of a sweep: drives, and what is varied. */
#pragma once
#include "base/config/Schema.h"

#include <string>
#include <vector>

namespace scanloom
{
/** One parameter of any verb that is varied; a single value is set in every run. */
struct AxisOptions
{
  std::string name;
  std::string values;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.name, Field{"name", "", "parameter that is varied, as section.key; empty: none"});
    visit(o.values, Field{"values", "", "values of the parameter, separated by |"});
  }
};

struct ExperimentOptions
{
  std::string simulations;
  std::string recordings;
  std::string references;
  std::string configurations;
  std::string lidars = "all";
  std::string every_nth = "1";
  std::string seeds = "1:10";
  bool keep_maps = false;
  bool keep_packets = false;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.simulations, Field{"simulations", "",
                               "INI files of simulated drives, separated by blanks; relative paths start at the folder "
                               "of this file. A drive is simulated once for all of its runs"});
    visit(o.recordings, Field{"recordings", "",
                              "recordings, each a file or folder as 'slam' takes it, separated by blanks; relative "
                              "paths start at the folder of this file"});
    visit(o.references,
          Field{"references", "",
                "what the trajectory is compared with, one for each recording, separated by blanks: positions of a "
                "total station (.csv, .tsv), poses (TUM, EuRoC, KITTI), or none; empty: a file total_station or "
                "groundtruth beside the recording, if there is one"});
    visit(o.configurations, Field{"configurations", "",
                                  "INI files that 'slam' reads in all runs, separated by blanks; if one of them finds "
                                  "the drive by $env{SCANLOOM_RECORDING}, slam takes it from there, else as its "
                                  "argument RECORDING"});
    visit(o.lidars, Field{"lidars", "",
                          "sets of lidars that are compared, separated by blanks; the names in a set are separated by "
                          "commas; all: all that the recording has"});
    visit(o.every_nth, Field{"every_nth", "", "values of N, separated by blanks: slam uses every N-th scan"});
    visit(o.seeds, Field{"seeds", "", "seeds of the simulated drives: a list separated by blanks, or first:last"});
    visit(o.keep_maps, Field{"keep_maps", "", "true: keep maps and keyframes of every run, about 50 MB each"});
    visit(o.keep_packets, Field{"keep_packets", "",
                                "true: keep the packets of simulated drives, 1.5 MB per second for two OS0-32 at "
                                "512x10"});
  }
};

struct ExperimentSettings
{
  ExperimentOptions experiment;
  std::vector<AxisOptions> axes{1};

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.experiment, Section{"experiment", "a sweep: every combination of what is listed here is run"});
    visit(s.axes, Section{"experiment", "a sweep: every combination of what is listed here is run", "axis"});
  }
};
}  // namespace scanloom
