/** What `evaluate` compares a trajectory with, and when the comparison misleads. */
#pragma once
#include "lab/evaluation/Evaluation.h"

#include <filesystem>
#include <functional>
#include <string>
#include <variant>

namespace scanloom
{
/**
 * Positions of a total station, or poses of a file or of a bag of ROS. `topic` chooses the poses of a bag; empty: the
 * only one. `warn` is called with what is left out. Throws UsageError for a topic where the file is no bag, and what
 * reading the file throws.
 */
std::variant<PositionTrack, Trajectory> readReference(const std::filesystem::path&, const std::string& topic,
                                                      const std::function<void(const std::string&)>& warn);

/** "x y z" in m. Throws UsageError for another text. */
Eigen::Vector3d leverArmOf(const std::string&);

/** Positions of a point of the machine are compared with the body's origin; empty if that is not so. */
std::string missingLeverArm(const EvaluationInput&, const EvaluationOptions&);

/** The reference's z is not up, as in poses of a camera: a turn about z leaves most of the error. Empty if it is up. */
std::string tiltedReference(const Evaluation& about_z, const EvaluationInput&, EvaluationOptions);
}  // namespace scanloom
