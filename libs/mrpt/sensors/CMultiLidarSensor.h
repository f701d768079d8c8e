#pragma once
#include "input/rig/RigOptions.h"
#include "mrpt/observations/RigObservations.h"
#include "mrpt/sensors/internal/HandedOver.h"
#include "mrpt/sensors/internal/ObservationFeed.h"

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/system/COutputLogger.h>

#include <memory>
#include <optional>

namespace scanloom
{
/**
 * Several spinning lidars as one sensor: one cloud per period with the measurement blocks of all lidars, by sampling
 * time, in time order and in the body frame.
 *
 * Its observations, in the order of the events:
 *  - first an mrpt::obs::CObservationComment that describes the lidars (RecordingHeader, JSON),
 *  - mrpt::obs::CObservationPointCloud, one per period, label `sensorLabel`: see Observations.h for its fields,
 *  - mrpt::obs::CObservationIMU, label imu for the body's own IMU and imu_NAME for that of lidar NAME.
 *
 *  \code
 *  PARAMETERS IN THE ".INI"-LIKE CONFIGURATION STRINGS:
 * -------------------------------------------------------
 *   [supplied_section_name]
 *   driver          = CMultiLidarSensor
 *   process_rate    = 100      // Hz, how often rawlog-grabber asks; mandatory there
 *   sensorLabel     = lidar    // of the clouds
 *   #cloud_class    = CGenericPointsMap   // or CPointsMapXYZI: for stock tools of MRPT 2.x without the plugin
 *   #grab_decimation = 0       // keep one scan of so many (header and IMU are all kept); 0: all
 *
 *   #pcap_input     = a.pcap, b.pcap      // captures, merged by record time; without them: live
 *   #pcap_output    = raw.pcap            // live: a capture of all that the lidars send; must not exist yet
 *   #bind_address   = 192.168.1.1         // live: receive on this address (or multicast group) only
 *   #receive_buffer = 16                  // live: MB per port, asked of the kernel
 *   #extrinsics     = extrinsics.txt      // lines 'T_body_NAME x y z yaw pitch roll' (m, deg)
 *   #imu_csv        = imu.csv             // the body's own IMU, EuRoC format
 *   #imu_pose       = [x y z yaw pitch roll]  // of the IMU in the body frame (m, deg); default: T_body_imu
 *
 *   lidar1_metadata = left.json           // the sensor's metadata; a lidar exists where this is given
 *   #lidar1_name    = lidar1
 *   #lidar1_pose    = [x y z yaw pitch roll]  // of the sensor in the body frame (m, deg); default: T_body_NAME
 *   #lidar1_port    = 0                   // UDP; 0: from the metadata
 *   #lidar1_imu_port = 0
 *   #lidar1_address = 192.168.1.10        // only where ports and serial numbers do not tell
 *   #lidar1_time_offset = 0               // s, added to its stamps
 *   // and lidar2_..., as many as there are
 *
 *   #scan_rate      = 10       // Hz, whatever the lidars' own rates are
 *   #scan_phase_ms  = 0        // scans start at multiples of the period plus this
 *   #deadline_ms    = 5        // how much later than its fastest packets a lidar may deliver
 *   #other_clock    = align    // a lidar of another clock is aligned by times of arrival; or quarantine, or refuse
 *   #slices         = 1        // parts of a scan that are given out as they are complete
 *  \endcode
 *
 * Live, the first SIGINT or SIGTERM ends the input, unless the application handles these signals itself. A second one
 * ends the application.
 *
 * At the end of the input, when the application has written everything, doProcess() throws "end of input: drained (not
 * an error)": an exception is the only way to stop rawlog-grabber. It then ends all sections, so run other sensors in a
 * grabber of their own. Set GRABBER_PERIOD_MS = 200 in [global].
 */
class CMultiLidarSensor : public mrpt::hwdrivers::CGenericSensor, public mrpt::system::COutputLogger
{
  DEFINE_GENERIC_SENSOR(CMultiLidarSensor)

 public:
  CMultiLidarSensor() : COutputLogger("CMultiLidarSensor") {}
  ~CMultiLidarSensor() override;

  /** Opens the captures or the sockets and begins to read. Throws what makeRig() and RigObservations throw. */
  void initialize() override;
  void doProcess() override;

 protected:
  /** Throws ConfigError with every key that is unknown or wrong. */
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase&, const std::string& section) override;

 private:
  using Time = HandedOver::Time;

  bool isLive() const { return settings_.rig.pcap_input.empty(); }
  void handOver(Time now);
  void give(const mrpt::obs::CObservation::Ptr&, Time now);
  bool isDecimated();
  void announceEnd();
  void logWarnings();
  void logAccount() const;

  RigSettings settings_;
  std::size_t scan_decimation_ = 0;  // 0 or 1: keep all
  std::size_t scans_left_out_ = 0;
  std::optional<HandedOver> scans_given_;  // from loadConfig on
  std::optional<HandedOver> others_given_;
  mrpt::Clock::time_point latest_stamp_;
  std::exception_ptr error_;  // that ended the input, if one did
  bool input_ended_ = false;
  std::unique_ptr<RigObservations> observations_;  // from initialize on; the feed's thread reads them
  std::unique_ptr<ObservationFeed> feed_;
};
}  // namespace scanloom
