/** HTTP requests to one sensor, with limits of time and memory. */
#pragma once
#include "base/core/Time.h"
#include "input/packets/SensorAddress.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace scanloom
{
enum class SensorFault
{
  Unreachable,    // nobody listens at the address
  TimedOut,       // no complete answer within the time limit, or cancel() was called
  Interrupted,    // the connection ended before the answer did
  Refused,        // an HTTP status other than 200
  TooLarge,       // more than the size limit
  Malformed,      // the answer is not what the endpoint should give
  WrongFirmware,  // too old for these endpoints
  NotRunning,     // it is starting, in standby or has an error
};

/** The message has address, endpoint, what happened and how to mend it. */
class SensorHttpError : public std::runtime_error
{
 public:
  SensorHttpError(SensorFault fault_kind, const std::string& message) : std::runtime_error(message), fault(fault_kind)
  {
  }

  SensorFault fault;
};

struct SensorHttpLimits
{
  Duration time = 2s;               // for all requests together, connecting included
  std::size_t bytes = 1024 * 1024;  // of one answer; metadata of 128 beams have 20 kB
};

/** Requests to one sensor. The time limit starts at construction. Redirects are not followed. */
class SensorHttp
{
 public:
  SensorHttp(const SensorAddress&, const SensorHttpLimits&);
  ~SensorHttp();

  SensorHttp(const SensorHttp&) = delete;
  SensorHttp& operator=(const SensorHttp&) = delete;

  /** The answer's body; nothing if the sensor has no such endpoint (404 or 405). Throws SensorHttpError. */
  std::optional<std::string> get(const std::string& endpoint);

  /** Sends JSON. False if the sensor has no such endpoint. Throws SensorHttpError. */
  bool post(const std::string& endpoint, const std::string& json);

  /** Makes the current request and all later ones fail with TimedOut at once. From any thread. */
  void cancel();

  /** An error about an answer of `endpoint`: "sensor 10.5.6.101: GET /api/...: `problem`". */
  SensorHttpError error(SensorFault, const std::string& endpoint, const std::string& problem) const;

  const SensorAddress& address() const { return address_; }

 private:
  class Connection;
  std::optional<std::string> request(const char* method, const std::string& endpoint, const std::string& body);
  SensorHttpError failure(const std::string& request, SensorFault, const std::string& problem) const;

  SensorAddress address_;
  SensorHttpLimits limits_;
  std::unique_ptr<Connection> connection_;
};
}  // namespace scanloom
