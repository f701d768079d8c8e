#pragma once
#include "input/packets/Datagram.h"
#include "input/rig/PacketRouter.h"

#include <vector>

namespace scanloom
{
/**
 * How many times as fast as the lidars' stamps the datagrams' times of reception run: 1, or the power of 1000 that a
 * wrong unit makes (ns written where us belong: 1000). By the median over neighbouring packets of a lidar.
 */
double receivePace(const std::vector<RoutedLidar>&, const std::vector<Datagram>&);
}  // namespace scanloom
