/** `scanloom config`: the parameters, as a file to start from and as a page of the manual. */
#include "Verb.h"
#include "config/ConfigError.h"
#include "config/Names.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct ConfigArguments
{
  std::string default_of;
  bool parameters = false;
};

const Verb& verbNamed(const std::string& name)
{
  std::vector<std::string> configurable;
  for (const Verb& verb : verbs())
  {
    if (verb.schema.empty()) continue;
    if (verb.name == name) return verb;
    configurable.push_back(verb.name);
  }
  throw UsageError(fmt::format("--default {}: no verb with parameters; {}", name, suggestion(name, configurable)));
}

std::string parametersPage()
{
  std::string page =
      "# Parameters\n\n"
      "Written by `scanloom config --parameters`. [configuration.md](configuration.md) says how the files are read.\n\n"
      "| verb | sections |\n|---|---|\n";
  for (const Verb& verb : verbs())
  {
    if (verb.schema.empty()) continue;
    std::vector<std::string> sections;
    for (const auto& described : verb.schema) sections.push_back(fmt::format("[{}]", described.section.name));
    page += fmt::format("| `{}` | {} |\n", verb.name, fmt::join(sections, ", "));
  }
  return page + "\n" + toMarkdown(knownToAnyVerb());
}

int run(const ConfigArguments& arguments)
{
  if (arguments.parameters)
    std::cout << parametersPage();
  else
    std::cout << toIni(verbNamed(arguments.default_of).schema);
  return kDone;
}

std::function<int()> addOptions(CLI::App& app)
{
  auto arguments = std::make_shared<ConfigArguments>();
  app.add_option("--default", arguments->default_of, "a commented INI file with the defaults of a verb")
      ->type_name("VERB");
  app.add_flag("--parameters", arguments->parameters, "the parameters of all verbs, as Markdown");
  app.require_option(1);
  return [arguments] { return run(*arguments); };
}
}  // namespace

Verb configVerb() { return {"config", "default configurations and the manual of the parameters", {}, &addOptions}; }
}  // namespace scanloom
