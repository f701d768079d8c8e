/** bits CAPTURE LEFT.json RIGHT.json EXTRINSICS.txt: digests of scans, preintegration and registration, every bit. */
#include "base/core/Digest.h"
#include "estimation/imu/Preintegration.h"
#include "estimation/ndt/Registration.h"
#include "input/rig/Rig.h"
#include "input/rig/openRig.h"

#include <cstdio>

using namespace scanloom;

namespace
{
template <typename Numbers>
std::string digestOf(const Numbers& numbers)
{
  return md5({reinterpret_cast<const std::uint8_t*>(numbers.data()), numbers.size() * sizeof(*numbers.data())});
}

std::string digestOf(const PointCloud& points)
{
  std::string digests;
  forEachField(points, [&](const auto& field) { digests += digestOf(field); });
  return md5({reinterpret_cast<const std::uint8_t*>(digests.data()), digests.size()});
}

RigSettings settingsOf(char** arguments)
{
  RigSettings settings;
  settings.rig.pcap_input = arguments[1];
  settings.rig.extrinsics = arguments[4];
  settings.lidars.resize(2);
  settings.lidars[0].name = "left", settings.lidars[0].metadata = arguments[2];
  settings.lidars[1].name = "right", settings.lidars[1].metadata = arguments[3];
  return settings;
}
}  // namespace

int main(int argc, char** argv)
{
  if (argc != 5) return 2;
  const auto input = openRig(makeRig(settingsOf(argv)));
  std::optional<NdtMap> before;
  std::vector<ImuSample> samples;
  while (const auto event = input->next())
  {
    if (const auto* imu = std::get_if<SensorImu>(&*event); imu && imu->sensor == 0) samples.push_back(imu->sample);
    const auto* scan = std::get_if<Scan>(&*event);
    if (!scan) continue;
    const NdtMap cells(scan->points, NdtOptions{});
    std::printf("scan %zu %s\n", scan->points.size(), digestOf(scan->points).c_str());
    if (before)
    {
      const RegistrationResult seen = align(*before, cells, Rigid::identity(), {});
      std::printf("pose %a %a %a, covariance %s\n", seen.target_T_source.translation.x(),
                  seen.target_T_source.translation.y(), seen.target_T_source.rotation.z(),
                  digestOf(seen.covariance).c_str());
    }
    before = cells;
  }
  const Preintegration motion = preintegrate(samples, {}, {});
  // Not its covariance: Eigen multiplies matrices wider than 8 by a kernel that always fuses multiply and add on ARM.
  std::printf("IMU %zu %a %a\n", samples.size(), motion.delta.position.x(), motion.delta.rotation.z());
  return 0;
}
