#include "diagnosis/DoctorJson.h"

#include "base/core/jsonText.h"

#include <nlohmann/json.hpp>

namespace scanloom
{
namespace
{
using nlohmann::json;

json jsonOf(const Delivery& d)
{
  json result = {{"packets", d.packets},
                 {"sent", d.sent()},
                 {"lost", d.loss.packets},
                 {"loss_share", d.lossShare()},
                 {"gaps", d.loss.gaps},
                 {"longest_gap_packets", d.loss.longest},
                 {"longest_gap_s", seconds(d.loss.longest_time)},
                 {"duplicates", d.order.duplicates},
                 {"reordered", d.order.reordered},
                 {"displacement_packets", d.order.displacement},
                 {"displacement_s", seconds(d.order.displacement_time)},
                 {"restarts", d.restarts},
                 {"blocks", d.blocks},
                 {"valid_share", d.validShare()},
                 {"nominal_packets_hz", d.rates.nominal_packets},
                 {"nominal_blocks_hz", d.rates.nominal_blocks}};
  if (d.rates.packets) result["packets_hz"] = *d.rates.packets;
  if (d.rates.blocks) result["blocks_hz"] = *d.rates.blocks;
  return result;
}

json jsonOf(const SensorFlags& f)
{
  return {{"alert_flags", f.alerts},
          {"alert_packets", f.alert_packets},
          {"thermal_status", f.worst_thermal_status},
          {"thermal_packets", f.thermal_packets},
          {"shot_limiting_status", f.worst_shot_limiting_status},
          {"shot_limiting_packets", f.shot_limiting_packets}};
}

json jsonOf(const ClockDrift& d) { return {{"ppm", d.ppm}, {"sigma_ppm", d.sigma_ppm}}; }

json clockOf(const LidarExamination& seen)
{
  const ClockExamination& clock = seen.clock;
  json result = {{"mode", seen.lidar.clock}, {"steps", json::array()}};
  if (clock.epoch) result["epoch"] = toString(*clock.epoch);
  if (clock.ahead_of_host) result["ahead_of_host_s"] = seconds(*clock.ahead_of_host);
  if (clock.ahead_of_first) result["ahead_of_first_s"] = seconds(*clock.ahead_of_first);
  if (clock.drift) result["drift"] = jsonOf(*clock.drift);
  if (clock.drift_to_first) result["drift_to_first"] = jsonOf(*clock.drift_to_first);
  for (const ClockStep& step : clock.steps)
    result["steps"].push_back({{"at_ns", nanoseconds(step.at)}, {"size_s", seconds(step.size)}});
  return result;
}

json jsonOf(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

json jsonOf(const GroundPlane& ground)
{
  return {{"up", jsonOf(ground.up)},
          {"tilt_deg", degreesBetween(ground.up, Eigen::Vector3d::UnitZ())},
          {"sensor_height_m", ground.sensor_height},
          {"body_height_m", ground.body_height},
          {"share", ground.share}};
}

json jsonOf(const LidarExamination& seen)
{
  json result = {{"name", seen.name},           {"model", seen.lidar.model}, {"serial", seen.lidar.serial},
                 {"malformed", seen.malformed}, {"bad_crc", seen.bad_crc},   {"delivery", jsonOf(seen.delivery)},
                 {"flags", jsonOf(seen.flags)}, {"clock", clockOf(seen)}};
  if (seen.jitter)
    result["jitter"] = {{"p50_s", seconds(seen.jitter->p50)},
                        {"p99_s", seconds(seen.jitter->p99)},
                        {"largest_s", seconds(seen.jitter->largest)},
                        {"late_share", seen.jitter->late_share}};
  if (const auto& phase = seen.clock.phase)
    result["rotor"] = {{"phase_at_start_s", phase->at_start},
                       {"phase_at_end_s", phase->at_end},
                       {"scatter_s", phase->scatter},
                       {"rate_error_ppm", phase->rate_error_ppm},
                       {"turn_s", phase->turn}};
  if (const auto& returns = seen.returns)
    result["returns"] = {{"share", returns->share},
                         {"range_p05_m", returns->range_p05},
                         {"range_p50_m", returns->range_p50},
                         {"range_p95_m", returns->range_p95}};
  if (seen.ground) result["ground"] = jsonOf(*seen.ground);
  if (seen.own_parts.known) result["own_parts"] = {{"share", seen.own_parts.share}};
  return result;
}

json jsonOf(const ImuExamination& imu)
{
  const ImuTiming& t = imu.timing;
  json result = {{"name", imu.name},
                 {"samples", t.samples},
                 {"gaps", t.gaps},
                 {"lost", t.lost},
                 {"longest_gap_s", seconds(t.longest_gap)},
                 {"backwards", t.backwards},
                 {"mean_force_in_body", jsonOf(imu.sound.force_in_body)},
                 {"tilt_deg", degreesBetween(imu.sound.force_in_body, Eigen::Vector3d::UnitZ())}};
  if (t.rate) result["rate_hz"] = *t.rate;
  if (imu.lidar_share) result["lidar_time_covered"] = *imu.lidar_share;
  if (imu.sound.gyro_scale)
    result["gyro_scale"] = {{"scale", imu.sound.gyro_scale->scale},
                            {"sigma", imu.sound.gyro_scale->sigma},
                            {"tilt_rate", imu.sound.gyro_scale->tilt_rate}};
  if (imu.compared && imu.compared->agreement)
  {
    const GyroAgreement& a = *imu.compared->agreement;
    result["gyro_to_reference"] = {{"reference", imu.compared->reference},
                                   {"rotation_rad", jsonOf(a.rotation)},
                                   {"sigma_rad", a.sigma},
                                   {"mirrored", a.mirrored},
                                   {"scale", a.scale},
                                   {"scale_sigma", a.scale_sigma},
                                   {"lag_s", seconds(a.lag)}};
  }
  return result;
}

json jsonOf(const PairExamination& pair, const RigExamination& rig)
{
  json result = {{"lidar", rig.lidars[pair.lidar].name}, {"reference", rig.lidars[pair.reference].name}};
  if (!pair.agreement) return result;
  const CloudAgreement& a = *pair.agreement;
  result["turns"] = a.turns;
  result["common_points"] = a.common;
  result["near_share"] = a.near_share;
  if (!a.correction) return result;
  result["offset_m"] = jsonOf(a.correction->offset);
  result["offset_sigma_m"] = a.correction->offset_sigma;
  result["rotation_rad"] = jsonOf(a.correction->rotation);
  result["near_share_corrected"] = a.correction->near_share;
  result["rotation_sigma_rad"] = a.correction->rotation_sigma;
  result["score_gain"] = a.correction->score_gain;
  return result;
}

std::string keyOf(Verdict verdict)
{
  switch (verdict)
  {
    case Verdict::Ok:
      return "ok";
    case Verdict::NotMeasured:
      return "not_measured";
    case Verdict::Warning:
      return "warning";
    case Verdict::NotFit:
      return "not_fit";
  }
  return "";
}
}  // namespace

std::string toJson(const RigExamination& rig, const Findings& findings)
{
  json result = {{"verdict", keyOf(worstOf(findings))}, {"lidars", json::array()}, {"findings", json::array()}};
  for (const LidarExamination& lidar : rig.lidars) result["lidars"].push_back(jsonOf(lidar));
  result["imus"] = json::array();
  for (const ImuExamination& imu : rig.imus) result["imus"].push_back(jsonOf(imu));
  if (rig.machine.known) result["machine"] = {{"share", rig.machine.share}, {"uncropped_share", rig.machine.uncropped}};
  if (!rig.machine.box.isEmpty())
  {
    result["machine"]["box_min_m"] = jsonOf(Eigen::Vector3d(rig.machine.box.min()));
    result["machine"]["box_max_m"] = jsonOf(Eigen::Vector3d(rig.machine.box.max()));
  }
  if (rig.sockets)
    result["sockets"] = {{"datagrams", rig.sockets->counters.datagrams},
                         {"filtered", rig.sockets->counters.filtered},
                         {"truncated", rig.sockets->counters.truncated},
                         {"dropped", rig.sockets->counters.dropped},
                         {"dropped_by_kernel", rig.sockets->counters.kernel_drops},
                         {"errors", rig.sockets->counters.errors},
                         {"host_clock_steps", rig.sockets->clock_steps}};
  result["pairs"] = json::array();
  for (const PairExamination& pair : rig.pairs) result["pairs"].push_back(jsonOf(pair, rig));
  for (const auto& [origin, datagrams] : rig.other_senders)
  {
    json sender = {{"source", origin.source.text()}, {"port", origin.destination_port}, {"datagrams", datagrams}};
    if (!origin.topic.empty()) sender["topic"] = origin.topic;
    result["strangers"].push_back(std::move(sender));
  }
  for (const Finding& f : findings)
    result["findings"].push_back({{"about", f.about},
                                  {"measure", f.measure},
                                  {"verdict", keyOf(f.verdict)},
                                  {"says", f.says},
                                  {"mend", f.mend}});
  return jsonText(result);
}
}  // namespace scanloom
