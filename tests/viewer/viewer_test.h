// Helpers for the tests of the viewer.
#pragma once

#include <string>

#include "mjcf/compile.h"
#include "physics/world_model.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"
#include "viewer/stage.h"

namespace understudy::viewer {

// A red ball of 1 m that floats free, 5 m over a dark floor, with a green arm of one hinge.
inline constexpr char kBallWorld[] = R"(
<mujoco>
  <worldbody>
    <light directional="true" pos="0 0 9" dir="0 0 -1"/>
    <geom name="floor" type="plane" size="0 0 1" rgba="0.1 0.1 0.1 1"/>
    <camera name="above" pos="0 0 20"/>
    <body name="ball" pos="0 0 5">
      <freejoint/>
      <geom size="1" rgba="1 0 0 1"/>
      <body name="arm" pos="0 0 1">
        <joint name="shoulder" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0 0 1" size="0.1" rgba="0 1 0 1"/>
        <geom type="box" size="0.5 0.5 0.5" group="3" rgba="0 0 1 1"/>
      </body>
    </body>
  </worldbody>
</mujoco>)";

// As mj_saveModel writes it.
inline std::string BinaryModel(const std::string& text) {
  mjcf::InstallMujocoHooks();
  const test::TemporaryFolder folder;
  const mjcf::ModelHandle model = physics::LoadModelFile(folder.Write("model.xml", text));
  std::string bytes(static_cast<std::size_t>(mj_sizeModel(model.get())), '\0');
  mj_saveModel(model.get(), nullptr, bytes.data(), static_cast<int>(bytes.size()));
  return bytes;
}

inline mjcf::ModelHandle BallModel() {
  return mjcf::ReadBinaryModel(BinaryModel(kBallWorld), "the test's");
}

// The ball there at that second.
inline SceneState BallAt(double x, double time = 0) {
  SceneState state;
  state.time = time;
  state.qpos = {x, 0, 5, 1, 0, 0, 0, 0};
  return state;
}

}  // namespace understudy::viewer
