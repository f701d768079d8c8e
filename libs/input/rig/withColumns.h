#pragma once
#include "input/batching/Scan.h"

namespace scanloom
{
/**
 * The scan with its columns, where its points are known and no packets tell them. The points are in the order of
 * (t, sensor_id); neighbours in which both are the same are a column, of at most 65535 points.
 */
Scan withColumns(Scan);
}  // namespace scanloom
