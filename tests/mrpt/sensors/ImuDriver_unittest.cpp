#include "mrpt/sensors/ImuDriver.h"

#include "mrpt/observations/Observations.h"

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/system/COutputLogger.h>

#include <gmock/gmock.h>

namespace scanloom::imu_driver_unittest
{
/** A sample 5 ms after the other; after `samples` of them it throws, as a driver does whose cable was pulled. */
class CTestImu : public mrpt::system::COutputLogger, public mrpt::hwdrivers::CGenericSensor
{
  DEFINE_GENERIC_SENSOR(CTestImu)
 public:
  CTestImu() : mrpt::system::COutputLogger("CTestImu") { m_sensorLabel = "imu"; }

  void doProcess() override
  {
    if (given_ == samples_) throw std::runtime_error("unplugged");
    const ImuSample sample{fromSeconds(1'750'000'000) + Timestamp{} + 5ms * given_++, {0.1, 0, 0}, {0, 0, 9.8}};
    appendObservation(toObservation(sample, Rigid::fromXyzYawPitchRoll(1, 2, 3, 0, 0, 0), m_sensorLabel));
  }

 protected:
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config, const std::string& section) override
  {
    samples_ = config.read_int(section, "samples", 3);
    if (samples_ < 0) throw std::runtime_error("samples is negative");
  }

 private:
  int samples_ = 0, given_ = 0;
};
IMPLEMENTS_GENERIC_SENSOR(CTestImu, scanloom::imu_driver_unittest)

namespace
{
using testing::HasSubstr;
using testing::ThrowsMessage;

mrpt::config::CConfigFileMemory sectionOf(const std::string& driver, const std::string& samples)
{
  CTestImu::doRegister();
  return mrpt::config::CConfigFileMemory("[body_imu]\ndriver = " + driver +
                                         "\nprocess_rate = 500\nsamples = " + samples + "\n");
}
}  // namespace

TEST(ImuDriver, givesWhatTheSensorGaveInItsOrderAndSaysWhyItEnded)
{
  ImuDriver driver(sectionOf("CTestImu", "20"), "body_imu");
  EXPECT_EQ(driver.body_T_imu(5s).translation, Eigen::Vector3d(1, 2, 3));
  std::vector<ImuSample> samples;
  std::optional<std::string> failure;
  for (int i = 0; i < 500 && !failure; ++i)
  {
    for (const ImuSample& sample : driver.take()) samples.push_back(sample);
    failure = driver.takeFailure();
    std::this_thread::sleep_for(10ms);
  }
  for (const ImuSample& sample : driver.take()) samples.push_back(sample);
  ASSERT_EQ(samples.size(), 20u);
  EXPECT_EQ(samples[19].stamp - samples[0].stamp, 95ms);
  EXPECT_EQ(samples[7].gyro, Eigen::Vector3d(0.1, 0, 0));
  EXPECT_THAT(failure.value_or(""), HasSubstr("[body_imu] gives no more samples: unplugged"));
  EXPECT_FALSE(driver.takeFailure());
}

TEST(ImuDriver, namesTheSectionOfADriverThatIsNotThereOrDoesNotStart)
{
  EXPECT_THAT([] { ImuDriver(sectionOf("CNoSuchImu", "1"), "body_imu"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("[body_imu] driver = CNoSuchImu: no such sensor")));
  EXPECT_THAT([] { ImuDriver(sectionOf("CTestImu", "-1"), "body_imu"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("[body_imu] CTestImu does not start")));
}

TEST(ImuDriver, saysSoWhenNoSampleComes)
{
  ImuDriver driver(sectionOf("CTestImu", "0"), "body_imu");
  EXPECT_THROW(driver.body_T_imu(200ms), std::runtime_error);
}
}  // namespace scanloom::imu_driver_unittest
