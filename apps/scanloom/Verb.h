/**
 * A verb of the program: one file that defines `Verb slamVerb()`, its declaration and one row of the table in main.cpp.
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
 * What run() throws becomes a message and a status: UsageError and ConfigError 2, everything else 1.
 */
#pragma once
#include "ExitCode.h"
#include "config/Schema.h"

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
  Schema schema;        // the sections it reads, said once: for checking, `config --default`, doc/parameters.md

  /** Adds the verb's options to its subcommand; what it returns is called after parsing and gives the ExitCode. */
  std::function<std::function<int()>(CLI::App&)> add;
};

/** The table in main.cpp. */
const std::vector<Verb>& verbs();

/** Every section and key that some verb reads: what a configuration file may hold. */
Schema knownToAnyVerb();
}  // namespace scanloom
