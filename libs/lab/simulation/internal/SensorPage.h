#pragma once
#include <cstdint>
#include <memory>
#include <string>

namespace scanloom
{
/** The web interface of a simulated Ouster sensor, on this computer: it tells its metadata and takes a configuration.
 */
class SensorPage
{
 public:
  /** `metadata` in the nested layout. `host`: any address of 127.0.0.0/8. Throws as LocalHttpServer does. */
  SensorPage(const std::string& metadata, const std::string& host);
  ~SensorPage();

  /** "127.0.0.2:41233", as the key 'address' takes it. */
  std::string address() const;

  void restart(std::uint32_t init_id);

 private:
  struct State;
  std::unique_ptr<State> state_;
};
}  // namespace scanloom
