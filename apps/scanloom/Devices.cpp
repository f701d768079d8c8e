#include "Devices.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
namespace
{
const Devices& loadedDevices()
{
  void* const library = ::dlopen("libscanloom_devices.so", RTLD_NOW);
  void* const get = library ? ::dlsym(library, "scanloomDevices") : nullptr;
  if (!get) throw std::runtime_error(fmt::format("MRPT's windows and drivers cannot be loaded: {}", ::dlerror()));
  return *reinterpret_cast<const Devices* (*)()>(get)();
}
}  // namespace

const Devices& devices()
{
  static const Devices& loaded = loadedDevices();
  return loaded;
}
}  // namespace scanloom
