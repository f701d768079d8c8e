/** A scene as if its recording were read, without any file: for drives too long to store. */
#pragma once
#include "input/rig/Rig.h"
#include "input/rig/SensorInput.h"
#include "lab/simulation/internal/Scene.h"

#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * The rig that reads the scene's recording: its lidars by the metadata and the extrinsics that would be written, to the
 * last decimal. `only` as makeRig has it; throws std::invalid_argument for a name that no lidar has.
 */
Rig rigOf(const Scene&, const BatcherOptions&, const std::vector<std::string>& only = {});

/** The scans and IMU samples of the scene's recording, to the bit; memory does not grow with its length. */
std::unique_ptr<SensorInput> makeSceneInput(std::shared_ptr<const Scene>, const Rig&);
}  // namespace scanloom
