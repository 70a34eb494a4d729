// Composes the scene that MuJoCo draws, from a separate model and positions, not those of the
// physics.
#pragma once

#include <string>

#include <mujoco/mujoco.h>

#include "mjcf/mujoco_handles.h"
#include "viewer/arguments.h"
#include "viewer/scene_state.h"

namespace understudy::viewer {

// A bounding sphere that the camera has to show.
struct Ball {
  Point center{};
  double radius = 0;  // m
};

class Stage {
 public:
  // Shows the model's reference pose at first. `robot` is the name of the robot in its world,
  // for a model of several.
  explicit Stage(mjcf::ModelHandle model, const std::string& robot = "");
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // Sets the positions. `state.qpos` has model().nq numbers; those that are not finite keep the old
  // value.
  void Show(const SceneState& state);
  const SceneState& state() const { return state_; }

  // Fills scene() for that camera. `perturb` may be null.
  void Compose(mjvCamera* camera, const ShowChoice& show, const mjvPerturb* perturb);

  // Adds a line with a ball at its end to the composed scene.
  void AddLine(const Point& from, const Point& to, const float rgba[4]);

  // Return the sphere around the robot, or around the subtree of a body, as of Show().
  Ball RobotBall() const;
  Ball BodyBall(int body) const;

  // Convert a point of a body to the world frame, and back.
  Point InWorld(int body, const Point& p) const;
  Point InBody(int body, const Point& p) const;

  // Return the id of a body or camera, by its name in the model or in the robot's own. Throw
  // ModelError with the nearest name if there is none.
  int Body(const std::string& name) const;
  int Camera(const std::string& name) const;

  // The root body of the robot.
  int root() const { return root_; }
  // Whether there is more for it to tread on than a plane.
  bool uneven() const;
  const mjModel& model() const { return *model_; }
  const mjData& data() const { return *data_; }
  std::size_t positions() const { return static_cast<std::size_t>(model_->nq); }
  mjVisual* visual() { return &model_->vis; }  // of the model, read when a context is made
  mjvScene* scene() { return &scene_; }
  const mjvOption& option() const { return option_; }
  double shadow_reach() const { return shadow_reach_; }  // m about the camera's aim, of Compose()

 private:
  bool Moves(int geom) const;
  bool OfRobots(int geom) const;
  bool Below(int body, int ancestor) const;
  void Choose(const ShowChoice& show);
  void AddForce(const SceneState::Force& force, const float rgba[4]);
  void AddDecor(const ShowChoice& show);
  void HideFreeJoints();
  void MoveSun(const mjvCamera& camera);

  mjcf::ModelHandle model_;
  std::string prefix_;  // of the robot's names, in a model of several
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
