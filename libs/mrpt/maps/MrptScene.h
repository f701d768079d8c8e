/** MRPT's 3D scenes: MRPT 3 has them in mrpt::viz, MRPT 2 in mrpt::opengl. */
#pragma once
#if __has_include(<mrpt/viz/Scene.h>)
#include <mrpt/viz/CGridPlaneXY.h>
#include <mrpt/viz/CPointCloudColoured.h>
#include <mrpt/viz/CSetOfLines.h>
#include <mrpt/viz/Scene.h>
#include <mrpt/viz/stock_objects.h>

namespace scanloom
{
namespace viz = mrpt::viz;
using MrptScene = viz::Scene;
}  // namespace scanloom
#else
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/stock_objects.h>

namespace scanloom
{
namespace viz = mrpt::opengl;
using MrptScene = viz::COpenGLScene;
}  // namespace scanloom
#endif
