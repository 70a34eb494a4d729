// Generated ground in a temporary folder, measured with rays.
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <type_traits>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "physics/world_model.h"
#include "terrain/image.h"
#include "terrain/terrain.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::terrain {

// How far [m] a ray goes until it meets the model, below 0 when it does not. `cast` is mj_ray,
// which later versions of MuJoCo ask where to put the normal, too.
template <typename Cast>
mjtNum CastRay(Cast cast, const mjModel* model, const mjData* data, const mjtNum* from,
               const mjtNum* along) {
  int geom = -1;
  if constexpr (std::is_invocable_v<Cast, const mjModel*, const mjData*, const mjtNum*,
                                    const mjtNum*, std::nullptr_t, int, int, int*>) {
    return cast(model, data, from, along, nullptr, 1, -1, &geom);
  } else {
    return cast(model, data, from, along, nullptr, 1, -1, &geom, nullptr);
  }
}

inline std::string Bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return bytes.str();
}

class TerrainTest : public test::MujocoTest {
 protected:
  // The scene in a folder of that name.
  std::filesystem::path Write(const std::string& kind, const std::string& name = "scene") {
    WriteTerrain(kind, spec_, folder_.path() / name);
    return folder_.path() / name;
  }

  // The ground alone, ready for rays.
  void Load(const std::string& kind) { LoadFile(Write(kind) / "scene.xml"); }
  void LoadFile(const std::filesystem::path& file) {
    model_ = physics::LoadModelFile(file);
    data_.reset(mj_makeData(model_.get()));
    mj_forward(model_.get(), data_.get());
  }

  // Height of the ground seen from above, m.
  double Height(double x, double y) const {
    constexpr double kAbove = 30;
    const mjtNum from[3] = {x, y, kAbove}, down[3] = {0, 0, -1};
    return kAbove - CastRay(mj_ray, model_.get(), data_.get(), from, down);
  }

  // How far [m] the ground of the patch lies from z = 0 on average.
  double Unevenness() const {
    double sum = 0;
    int count = 0;
    for (double x = 1.52; x < 9.5; x += 0.13) {
      for (double y = -1.9; y < 2; y += 0.37) {
        sum += std::abs(Height(x, y));
        ++count;
      }
    }
    return sum / count;
  }

  std::string Refusal(const std::string& kind) {
    try {
      Write(kind);
    } catch (const ModelError& error) {
      EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
      return error.what();
    }
    return "";
  }

  // 3 x 2 pixels: black, grey, white over white, grey, black.
  void UseImage() {
    WriteGreyPng(folder_.path() / "image.png", 3, 2, {0, 32768, 65535, 65535, 32768, 0});
    spec_.image = folder_.path() / "image.png";
  }

  test::TemporaryFolder folder_;
  TerrainSpec spec_;
  mjcf::ModelHandle model_;
  mjcf::DataHandle data_;
};

}  // namespace understudy::terrain
