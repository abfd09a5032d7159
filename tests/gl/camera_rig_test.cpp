// SPDX-License-Identifier: MIT
#include "gl/camera_rig.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spindrift::gl
{
namespace
{

void expect_orthonormal(const View& view)
{
    EXPECT_NEAR(dot(view.right, view.right), 1, 1e-5);
    EXPECT_NEAR(dot(view.up, view.up), 1, 1e-5);
    EXPECT_NEAR(dot(view.forward, view.forward), 1, 1e-5);
    const Vec3f ahead = cross(view.up, view.right);
    EXPECT_NEAR(dot(ahead, view.forward), 1, 1e-5) << "right x forward = up";
}

TEST(CameraRig, LeavesTheSceneCameraAloneUntilTouched)
{
    CameraRig rig;
    View scene;
    scene.eye = {1, 2, 3};
    rig.advance({}, scene, 0.1);
    EXPECT_EQ(rig.mode(), CameraMode::scene);
    EXPECT_EQ(rig.view(scene).eye.y, 2);
}

TEST(CameraRig, FlyingStartsWhereTheSceneCameraStands)
{
    CameraRig rig;
    View scene;
    scene.eye = {1, 2, 3};
    scene.forward = {0.6F, 0.8F, 0};
    scene.right = {0.8F, -0.6F, 0};
    CameraInput input;
    input.forward = 1;
    rig.advance(input, scene, 0.5);
    const View view = rig.view(scene);
    EXPECT_EQ(rig.mode(), CameraMode::fly);
    const float way = rig.speed_m_s() * 0.5F;
    EXPECT_NEAR(view.eye.x, 1 + 0.6F * way, 1e-4);
    EXPECT_NEAR(view.eye.y, 2 + 0.8F * way, 1e-4);
    EXPECT_NEAR(view.right.x, 0.8F, 1e-5);
    expect_orthonormal(view);
}

TEST(CameraRig, SpeedIsPerSecondNotPerFrame)
{
    View scene;
    CameraInput input;
    input.right = 1;
    CameraRig coarse;
    CameraRig fine;
    coarse.advance(input, scene, 1.0);
    for (int i = 0; i < 100; ++i) fine.advance(input, scene, 0.01);
    EXPECT_NEAR(coarse.view(scene).eye.x, fine.view(scene).eye.x, 1e-3);
}

TEST(CameraRig, OrbitKeepsItsTarget)
{
    CameraRig rig;
    View scene;
    CameraInput input;
    input.orbit_x_px = 120;
    input.orbit_y_px = -40;
    rig.advance(input, scene, 0.1);
    const View view = rig.view(scene);
    EXPECT_EQ(rig.mode(), CameraMode::orbit);
    const Vec3f target = view.eye + view.forward * 15.0F;
    EXPECT_NEAR(target.x, 0, 1e-4);
    EXPECT_NEAR(target.y, 15, 1e-4);
    EXPECT_NEAR(target.z, 0, 1e-4);
    expect_orthonormal(view);
}

TEST(CameraRig, NeverTipsOver)
{
    CameraRig rig;
    View scene;
    CameraInput input;
    input.look_y_px = -5000;
    rig.advance(input, scene, 0.1);
    EXPECT_GT(rig.view(scene).up.z, 0);
    expect_orthonormal(rig.view(scene));
    input.look_y_px = 50000;
    rig.advance(input, scene, 0.1);
    EXPECT_GT(rig.view(scene).up.z, 0);
}

TEST(CameraRig, GivesTheSceneItsCameraBack)
{
    CameraRig rig;
    View scene;
    CameraInput input;
    input.forward = 1;
    rig.advance(input, scene, 1);
    input = {};
    input.back_to_scene = true;
    rig.advance(input, scene, 1);
    EXPECT_EQ(rig.mode(), CameraMode::scene);
    EXPECT_EQ(rig.view(scene).eye.y, scene.eye.y);
}

}  // namespace
}  // namespace spindrift::gl
