/** What the module is made of: each adds its classes and functions. */
#pragma once
#include <pybind11/pybind11.h>

namespace scanloom
{
void bindScans(pybind11::module_&);         // Cloud, Scan, ImuSamples, Scans
void bindPoses(pybind11::module_&);         // Pose, Slam, write_trajectory
void bindOdometry(pybind11::module_&);      // Odometry
void bindRegistration(pybind11::module_&);  // Registration, register
void bindSite(pybind11::module_&);          // Place, Site
void bindEvaluation(pybind11::module_&);    // Evaluation, evaluate
}  // namespace scanloom
