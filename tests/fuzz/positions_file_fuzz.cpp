/**
 * Any text as a file of positions by a total station or GNSS: finite positions in order of time, with a standard
 * deviation above 0 or none, or std::invalid_argument. The first byte chooses a header; and whether the rest is text,
 * or a word of such a file for each byte. fuzz options: -max_len=512
 */
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "MemoryFile.h"
#include "base/positions/TotalStation.h"
#include "wordsOf.h"

using namespace scanloom;

namespace
{
const std::array<std::string, 8> kHeaders{"",
                                          "t,x,y,z\n",
                                          "#t [s],lat [deg],lon [deg],height [m]\n",
                                          "name;t [ms];n [ft];e [ft];h [cm];sigma [mm]\n",
                                          "# of the instrument\n",
                                          "t x y z\n",
                                          "time\teasting\tnorthing\televation\tpoint\taccuracy\n",
                                          "2026-11-23T10:15:30.250Z,1,2,3\n"};

const std::array<std::string, 32> kWords{",",
                                         ";",
                                         "\t",
                                         " ",
                                         "\n",
                                         "\r\n",
                                         "#",
                                         "-",
                                         ".",
                                         "0",
                                         "1",
                                         "2",
                                         "9",
                                         "90",
                                         "180",
                                         "1,2,3,",
                                         "1;2,5;3",
                                         "1750000000",
                                         "1e9",
                                         "1e308",
                                         "-1e308",
                                         "nan",
                                         "inf",
                                         "t",
                                         "x",
                                         "lat",
                                         "lon",
                                         "sigma",
                                         "2026-02-30T00:00:00Z",
                                         "2026-11-23 10:15:30+02:00",
                                         "P1",
                                         "\""};

void use(const PositionFile& file)
{
  for (std::size_t i = 0; i < file.track.size(); ++i)
  {
    const StampedPosition& at = file.track[i];
    require(at.position.allFinite());
    require(std::isfinite(at.sigma) && at.sigma >= 0);
    require(i == 0 || file.track[i - 1].stamp < at.stamp);
  }
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const FuzzFolder folder;
  static const MemoryFile positions(folder, "positions.csv");
  if (size == 0) return 0;
  const std::string rest(data + 1, data + size);
  const std::string text = kHeaders[data[0] % kHeaders.size()] + (data[0] & 8 ? wordsOf(rest, kWords) : rest);
  mayThrow<std::invalid_argument>([&] { use(readPositionFile(positions.holding(text))); });
  return 0;
}
