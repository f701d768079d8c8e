/** What a sweep varies. */
#pragma once
#include "config/Schema.h"

#include <string>
#include <vector>

namespace scanloom
{
/** Any parameter of any verb; with a single value it is set in every run. */
struct AxisOptions
{
  std::string name;
  std::string values;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.name, Field{"name", "", "a parameter, section.key; empty: no axis"});
    visit(o.values, Field{"values", "", "its values, with | between them"});
  }
};

struct ExperimentOptions
{
  std::string simulations;
  std::string recordings;
  std::string configurations;
  std::string lidars = "left,right";
  std::string every_nth = "1";
  std::string seeds = "1:10";
  bool keep_maps = false;
  bool keep_packets = false;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.simulations, Field{"simulations", "",
                               "INI files of stands, with blanks between them; paths as seen from "
                               "this file. Each drive is simulated once, for all of its runs"});
    visit(o.recordings, Field{"recordings", "", "folders as 'simulate' writes them, likewise"});
    visit(o.configurations, Field{"configurations", "",
                                  "INI files of 'slam' for all runs, likewise; they find each drive's folder by "
                                  "$env{SCANLOOM_RECORDING}"});
    visit(o.lidars, Field{"lidars", "", "sets of lidars, names of one set with commas, sets with blanks between them"});
    visit(o.every_nth, Field{"every_nth", "", "of the scans, with blanks between them"});
    visit(o.seeds, Field{"seeds", "", "of the simulations: a list with blanks, or first:last"});
    visit(o.keep_maps, Field{"keep_maps", "", "true: maps and keyframes of every run, some 50 MB each"});
    visit(o.keep_packets, Field{"keep_packets", "",
                                "true: packets of simulated drives stay, 1.5 MB for a second of two OS0-32 at 512x10"});
  }
};

struct ExperimentSettings
{
  ExperimentOptions experiment;
  std::vector<AxisOptions> axes{1};

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.experiment, Section{"experiment", "a sweep: what is combined with what"});
    visit(s.axes, Section{"experiment", "a sweep: what is combined with what", "axis"});
  }
};
}  // namespace scanloom
