// Scenes at random, for rays.
#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <string>

#include <mujoco/mujoco.h>

#include "mjcf/mujoco_handles.h"
#include "perception/ray.h"
#include "physics/world_model.h"
#include "tests/support/temporary_folder.h"

namespace understudy::test {

// A plane, `count` geoms of every type that stand still and twice as many that fall, and a height
// field. Two things that mj_rayHfield of MuJoCo 2.2.2 does differ from what the field's triangles
// say, and are avoided: it confuses rows and columns at the walls, so these are as many, and it has
// rays that begin within the field meet the level of its base.
class RandomScene {
 public:
  explicit RandomScene(unsigned seed, int count = 20) : random_(seed) {
    std::string still, moving;
    for (int i = 0; i < count; ++i) {
      still += Geom();
      moving += "<body pos='" + Numbers(3, -5, 5) + "'><freejoint/>" + Geom() + Geom() + "</body>";
    }
    const TemporaryFolder folder;
    model = physics::LoadModelFile(folder.Write("scene.xml", R"(<mujoco><asset>
        <mesh name="gem" vertex="1 0 0  -1 0 0  0 1 0  0 -1 0  0 0 1  0 0 -1"/>
        <hfield name="hills" nrow="30" ncol="30" size="4 3 0.8 0.3"/></asset><worldbody>
        <geom type="plane" size="0 0 1" pos="0 0 -2"/>
        <geom type="hfield" hfield="hills" pos="1 -1 -1.5"/>)" + still +
                                                                 moving + "</worldbody></mujoco>"));
    for (int r = 1; r + 1 < 30; ++r) {
      for (int c = 1; c + 1 < 30; ++c) {
        model->hfield_data[r * 30 + c] = static_cast<float>(Between(0, 1));
      }
    }
    data.reset(mj_makeData(model.get()));
    mj_kinematics(model.get(), data.get());
  }

  // Lets all that can fall go on for a while.
  void Move() {
    for (int i = 0; i < model->nv; ++i) data->qvel[i] = Between(-2, 2);
    mj_integratePos(model.get(), data->qpos, data->qvel, 0.7);
    mj_kinematics(model.get(), data.get());
  }

  perception::Ray Ray() {
    Eigen::Vector3d origin;
    do {
      origin = {Between(-6, 6), Between(-6, 6), Between(-2, 4)};
    } while (((origin - kField).cwiseAbs() - kHalfField).maxCoeff() < 0);
    const Eigen::Vector3d towards(Between(-1, 1), Between(-1, 1), Between(-1, 1));
    return {origin, towards.normalized()};
  }

  // What mj_ray says.
  perception::Hit Slowly(const perception::Ray& ray) const {
    perception::Hit hit;
    const double t = mj_ray(model.get(), data.get(), ray.origin.data(), ray.direction.data(),
                            nullptr, 1, -1, &hit.geom
#if mjVERSION_HEADER >= 350
                            ,
                            nullptr
#endif
    );
    if (t >= 0) hit.distance = t;
    return hit;
  }

  mjcf::ModelHandle model;
  mjcf::DataHandle data;

 private:
  inline static const Eigen::Vector3d kField{1, -1, -1.5}, kHalfField{4, 3, 0.8};

  double Between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  std::string Numbers(int count, double low, double high) {
    std::string text;
    for (int i = 0; i < count; ++i) text += std::to_string(Between(low, high)) + " ";
    return text;
  }
  std::string Geom() {
    static constexpr const char* kTypes[] = {"sphere",   "capsule", "ellipsoid",
                                             "cylinder", "box",     "mesh"};
    const std::string type = kTypes[std::uniform_int_distribution<int>(0, 5)(random_)];
    const std::string shape =
        type == "mesh" ? "mesh='gem'" : "size='" + Numbers(3, 0.05, 0.8) + "'";
    return "<geom type='" + type + "' " + shape + " pos='" + Numbers(3, -4, 4) + "' euler='" +
           Numbers(3, -180, 180) + "'/>";
  }

  std::mt19937 random_;
};

}  // namespace understudy::test
