/**
 * Any text is either a configuration or a ConfigError.
 * fuzz options: -max_len=512
 */
#include "base/config/Configuration.h"
#include "base/core/Text.h"

#include <string_view>

#include "require.h"

using namespace scanloom;

namespace
{
/** One field of every type that an option may have. */
struct EveryType
{
  bool yes = false;
  int count = 3;
  double size = 0.5;
  std::string name;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.yes, Field{"a", "", "on or off"});
    visit(o.count, Field{"b", "", "whole", atLeast(2)});
    visit(o.size, Field{"c", "m", "any", between(0, 1)});
    visit(o.name, Field{"d", "", "text"});
  }
};

/** A formula is a program to exprtk: a loop in it may well run for ever, as it would in MRPT. */
bool mayLoop(std::string_view text)
{
  for (const char* loop : {"while", "WHILE", "repeat", "REPEAT", "for", "FOR"})
    if (text.find(loop) != std::string_view::npos) return true;
  return false;
}

void readAll(std::string_view text)
{
  const Configuration configuration = Configuration::fromText(text, "fuzz.ini");
  for (const std::string& section : configuration.sections())
  {
    for (const std::string& key : configuration.keys(section))
    {
      require(!key.empty() && configuration.place(section, key).line > 0);
      require(trimmed(configuration.text(section, key)) == configuration.text(section, key));
    }
    const auto options = configuration.read<EveryType>(section);
    require(options.count >= 2 && options.size >= 0 && options.size <= 1);
  }
  configuration.refuseUnknown({});
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (mayLoop(text)) return 0;
  mayThrow<ConfigError>([&] { readAll(text); });
  return 0;
}
