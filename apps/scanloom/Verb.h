/**
 * A verb of the program: a file that defines `Verb slamVerb()`, and in allVerbs.cpp its declaration and a row of the
 * table.
 *
 *   int run(const SlamArguments& arguments)
 *   {
 *     const Loaded<SlamSettings> loaded = load<SlamSettings>(arguments.configuration);
 *     refuseExisting(arguments.output, {"trajectory.tum", "configuration.ini"});
 *     if (arguments.configuration.dry_run)
 *     {
 *       std::cout << toIni(loaded);
 *       return kDone;
 *     }
 *     ...
 *     return interrupted() ? kInterrupted : kDone;
 *   }
 *
 *   std::function<int()> addOptions(CLI::App& app)
 *   {
 *     auto arguments = std::make_shared<SlamArguments>();
 *     addConfiguration(app, arguments->configuration);
 *     addOutputFolder(app, arguments->output)->required();
 *     return [arguments] { return run(*arguments); };
 *   }
 *
 *   Verb slamVerb() { return {"slam", "trajectory and map of a recording", schemaOf<SlamSettings>(), &addOptions}; }
 *
 * An exception from run() becomes a message on stderr and the status: 2 for UsageError and ConfigError, otherwise 1.
 */
#pragma once
#include "base/config/Schema.h"
#include "base/core/ExitCode.h"

#include <functional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace scanloom
{
struct Verb
{
  std::string name;
  std::string purpose;  // one line of --help
  Schema schema;        // the sections that it reads: for checks, `config --default` and doc/parameters.md

  /** Adds the verb's options to its subcommand. @return the function to call after parsing; it returns the ExitCode. */
  std::function<std::function<int()>(CLI::App&)> add;
};

/** The table in allVerbs.cpp. */
const std::vector<Verb>& verbs();

/** The sections and keys of all verbs: a configuration file may have these. */
Schema knownToAnyVerb();
}  // namespace scanloom
