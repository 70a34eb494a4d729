// The robot and its surroundings as MuJoCo draws them: a model and positions of our own, never
// those of the physics.
#pragma once

#include <string>

#include <mujoco/mujoco.h>

#include "mjcf/mujoco_handles.h"
#include "viewer/arguments.h"
#include "viewer/scene_state.h"

namespace understudy::viewer {

// A ball around something: what a camera has to see of it.
struct Ball {
  Point center{};
  double radius = 0;  // m
};

class Stage {
 public:
  // Shows the model's reference pose until told otherwise.
  explicit Stage(mjcf::ModelHandle model);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // Puts the robot there. `state.qpos` has model().nq numbers; what is not finite in it stays.
  void Show(const SceneState& state);
  const SceneState& state() const { return state_; }

  // Fills scene() for a look by that camera. `perturb` may be null.
  void Compose(mjvCamera* camera, const ShowChoice& show, const mjvPerturb* perturb);

  // Adds a line with a ball at its end to what was composed.
  void AddLine(const Point& from, const Point& to, const float rgba[4]);

  // Of the robot, or of a body with all that hangs on it. As of Show().
  Ball RobotBall() const;
  Ball BodyBall(int body) const;

  // A point of a body in the world, and one of the world in the body's frame.
  Point InWorld(int body, const Point& p) const;
  Point InBody(int body, const Point& p) const;

  // Throws ModelError with the nearest name when there is none.
  int Body(const std::string& name) const;
  int Camera(const std::string& name) const;

  // The body that the robot hangs together by.
  int root() const { return root_; }
  const mjModel& model() const { return *model_; }
  const mjData& data() const { return *data_; }
  std::size_t positions() const { return static_cast<std::size_t>(model_->nq); }
  mjVisual* visual() { return &model_->vis; }  // of the model, read when a context is made
  mjvScene* scene() { return &scene_; }
  const mjvOption& option() const { return option_; }
  double shadow_reach() const { return shadow_reach_; }  // m about the camera's aim, of Compose()

 private:
  bool Moves(int geom) const;
  bool Below(int body, int ancestor) const;
  void Choose(const ShowChoice& show);
  void AddForce(const SceneState::Force& force, const float rgba[4]);
  void AddDecor(const ShowChoice& show);
  void MoveSun(const mjvCamera& camera);

  mjcf::ModelHandle model_;
  mjcf::DataHandle data_;
  mjvScene scene_;
  mjvOption option_;
  SceneState state_;
  int root_ = 0;
  double size_ = 0;              // m: radius of the robot in its reference pose
  bool only_collision_ = false;  // the robot has no other shapes
  double shadow_reach_ = 0;
};

}  // namespace understudy::viewer
