/** Calls of Cyclone DDS that several files make. */
#pragma once
#include <dds/dds.h>

#include <memory>
#include <string>

namespace scanloom
{
/** Throws std::runtime_error for the codes of Cyclone's errors. */
dds_entity_t checked(dds_entity_t result, const std::string& what);

using Qos = std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)>;

Qos newQos();

/** The newest `messages` are kept, `for_latecomers`: also for readers that come later. */
Qos qosOf(bool reliable, bool for_latecomers, int messages);

/** A sink of Cyclone's log: writes the first warnings to stderr. */
void logToPerson(void*, const dds_log_data_t* line);
}  // namespace scanloom
