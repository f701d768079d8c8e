/** Merges what two lidars of one machine sent, and registers each scan to the one before. */
#include <estimation/ndt/Registration.h>
#include <input/rig/Rig.h>
#include <input/rig/openRig.h>

#include <cstdio>
#include <exception>

int main(int argc, char** argv)
try
{
  if (argc != 5) return std::puts("usage: merge_and_register CAPTURE.pcap LEFT.json RIGHT.json EXTRINSICS.txt"), 2;
  scanloom::RigSettings settings;
  settings.rig.pcap_input = argv[1];  // or several, separated by commas
  settings.rig.extrinsics = argv[4];  // lines 'T_body_left x y z yaw pitch roll' (m, deg)
  settings.lidars.resize(2);
  settings.lidars[0].name = "left", settings.lidars[0].metadata = argv[2];
  settings.lidars[1].name = "right", settings.lidars[1].metadata = argv[3];

  const auto input = scanloom::openRig(makeRig(settings));
  std::optional<scanloom::NdtMap> before;
  while (const auto event = input->next())
  {
    const auto* scan = std::get_if<scanloom::Scan>(&*event);
    if (!scan) continue;  // an IMU sample
    const scanloom::NdtMap cells(scan->points, scanloom::NdtOptions{});
    std::printf("%zu columns, %zu points", scan->columns.size(), scan->points.size());
    if (before)
    {
      const auto seen = align(*before, cells, scanloom::Rigid::identity(), {});
      const auto& travel = seen.target_T_source.translation;
      std::printf(", moved by %.3f %.3f %.3f m: %s", travel.x(), travel.y(), travel.z(),
                  toString(seen.outcome).c_str());
    }
    std::printf("\n");
    before = cells;
  }
  return 0;
}
catch (const std::exception& e)
{
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
