// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec.h"
#include "core/view.h"

namespace spindrift::gl
{

enum class CameraMode
{
    scene,  ///< as the scene's camera keys say
    fly,    ///< moved by keys, turned by dragging
    orbit,  ///< turned round a point ahead
};

/// What a person asks of the camera in one frame.
struct CameraInput
{
    float right = 0, up = 0, forward = 0;  ///< -1..1, keys held
    bool fast = false;
    float look_x_px = 0, look_y_px = 0;    ///< drag that turns the camera; y downwards
    float orbit_x_px = 0, orbit_y_px = 0;  ///< drag that turns it round its target
    float zoom = 0;                        ///< wheel notches: nearer to the target, or faster when flying
    bool back_to_scene = false;
};

/// The pose of a camera that a person steers. Knows no window: pure state, moved by input.
class CameraRig
{
  public:
    void advance(const CameraInput& input, const View& scene_view, double dt_s);

    /// The scene's view with the steered pose in place of its own.
    View view(const View& scene_view) const;
    CameraMode mode() const { return mode_; }
    float speed_m_s() const { return speed_m_s_; }

  private:
    void take_pose(const View& view);
    Vec3f forward() const;
    void fly(const CameraInput& input, float dt_s);
    void orbit(const CameraInput& input);

    CameraMode mode_ = CameraMode::scene;
    Vec3f eye_{};
    float yaw_ = 0, pitch_ = 0;  ///< radians; yaw 0 looks along +y, grows towards +x
    float target_m_ = 15;        ///< distance of the point that orbiting turns round
    float speed_m_s_ = 8;
};

}  // namespace spindrift::gl
