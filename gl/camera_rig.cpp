// SPDX-License-Identifier: MIT
#include "gl/camera_rig.h"

#include <algorithm>
#include <cmath>

namespace spindrift::gl
{

namespace
{

constexpr float kRadiansPerPx = 0.004F;
constexpr float kSteepest = 1.55F;  // just short of straight up, where yaw loses its meaning
constexpr float kPerNotch = 0.87F;
constexpr float kFast = 5;

Vec3f direction(float yaw, float pitch)
{
    return {std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch), std::sin(pitch)};
}

Vec3f rightwards(float yaw)
{
    return {std::cos(yaw), -std::sin(yaw), 0};
}

}  // namespace

Vec3f CameraRig::forward() const
{
    return direction(yaw_, pitch_);
}

void CameraRig::take_pose(const View& view)
{
    eye_ = view.eye;
    yaw_ = std::atan2(view.forward.x, view.forward.y);
    pitch_ = std::asin(std::clamp(view.forward.z, -1.0F, 1.0F));
}

void CameraRig::fly(const CameraInput& input, float dt_s)
{
    mode_ = CameraMode::fly;
    yaw_ += input.look_x_px * kRadiansPerPx;
    pitch_ = std::clamp(pitch_ - input.look_y_px * kRadiansPerPx, -kSteepest, kSteepest);
    speed_m_s_ = std::clamp(speed_m_s_ * std::pow(kPerNotch, -input.zoom), 0.1F, 500.0F);
    const float way_m = speed_m_s_ * dt_s * (input.fast ? kFast : 1.0F);
    eye_ = eye_ + rightwards(yaw_) * (input.right * way_m) + forward() * (input.forward * way_m) +
           Vec3f{0, 0, input.up * way_m};
}

void CameraRig::orbit(const CameraInput& input)
{
    mode_ = CameraMode::orbit;
    const Vec3f target = eye_ + forward() * target_m_;
    yaw_ += input.orbit_x_px * kRadiansPerPx;
    pitch_ = std::clamp(pitch_ - input.orbit_y_px * kRadiansPerPx, -kSteepest, kSteepest);
    target_m_ = std::clamp(target_m_ * std::pow(kPerNotch, input.zoom), 0.2F, 5000.0F);
    eye_ = target - forward() * target_m_;
}

void CameraRig::advance(const CameraInput& input, const View& scene_view, double dt_s)
{
    if (input.back_to_scene)
    {
        mode_ = CameraMode::scene;
        return;
    }
    const bool flies = input.right != 0 || input.up != 0 || input.forward != 0 || input.look_x_px != 0 ||
                       input.look_y_px != 0;
    const bool orbits = input.orbit_x_px != 0 || input.orbit_y_px != 0;
    const bool zooms = input.zoom != 0;
    if (!flies && !orbits && !zooms) return;
    if (mode_ == CameraMode::scene) take_pose(scene_view);
    if (orbits || (zooms && mode_ != CameraMode::fly && !flies))
        orbit(input);
    else
        fly(input, static_cast<float>(dt_s));
}

View CameraRig::view(const View& scene_view) const
{
    if (mode_ == CameraMode::scene) return scene_view;
    View view = scene_view;
    view.eye = eye_;
    view.forward = forward();
    view.right = rightwards(yaw_);
    view.up = cross(view.right, view.forward);
    return view;
}

}  // namespace spindrift::gl
