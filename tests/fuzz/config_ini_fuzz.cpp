/** Any text is either a configuration or a ConfigError. */
#include "config/Configuration.h"

#include <cstdlib>
#include <string_view>

namespace scanloom
{
namespace
{
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
    for (const std::string& key : configuration.keys(section))
    {
      const bool has_place = configuration.place(section, key).line > 0;
      if (key.empty() || !has_place || trimmed(configuration.text(section, key)) != configuration.text(section, key))
        std::abort();
    }
  configuration.refuseUnknown({});
}
}  // namespace
}  // namespace scanloom

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (scanloom::mayLoop(text)) return 0;
  try
  {
    scanloom::readAll(text);
  }
  catch (const scanloom::ConfigError&)
  {
  }
  return 0;
}
