// Places: walls and things around the start.
#include "terrain/places.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "config/load.h"
#include "physics/mujoco_world.h"
#include "tests/terrain/fixture.h"

namespace understudy::terrain {
namespace {

using testing::HasSubstr;

class PlacesTest : public TerrainTest {
 protected:
  // How far [m] a ray in the direction (dx, dy) goes from there, at most 1000.
  double Sight(double x, double y, double z, double dx, double dy) const {
    const mjtNum from[3] = {x, y, z}, along[3] = {dx, dy, 0};
    const double way = CastRay(mj_ray, model_.get(), data_.get(), from, along);
    return way < 0 ? 1000 : way;
  }

  bool Solid(int geom) const {
    return model_->geom_contype[geom] != 0 || model_->geom_conaffinity[geom] != 0;
  }

  int SolidGeoms() const {
    int count = 0;
    for (int geom = 0; geom < model_->ngeom; ++geom) count += Solid(geom) ? 1 : 0;
    return count;
  }
};

TEST_F(PlacesTest, AreFreeAroundTheStartHoweverMuchStandsAbout) {
  constexpr double kRug = 0.015;  // m
  for (const std::string& place : PlaceNames()) {
    for (const double difficulty : {0.0, 1.0}) {
      for (spec_.seed = 1; spec_.seed < 6; ++spec_.seed) {
        spec_.difficulty = difficulty;
        Load(place);
        for (double x = -1.3; x < 1.31; x += 0.1) {
          for (double y = -0.7; y < 0.71; y += 0.1) {
            ASSERT_LT(Height(x, y), kRug) << place << " at " << x << ", " << y;
          }
        }
      }
    }
  }
}

TEST_F(PlacesTest, AreTheSameToTheBitForTheSameSeedAndDifferForAnother) {
  for (const std::string& place : PlaceNames()) {
    spec_.seed = 1;
    const std::string one = Bytes(Write(place, "a_" + place) / "scene.xml");
    EXPECT_EQ(one, Bytes(Write(place, "b_" + place) / "scene.xml")) << place;
    spec_.seed = 2;
    EXPECT_NE(one, Bytes(Write(place, "c_" + place) / "scene.xml")) << place;
  }
}

TEST_F(PlacesTest, HaveMoreStandingAboutTheHigherTheDifficulty) {
  for (const std::string& place : PlaceNames()) {
    int last = 0;
    for (const double difficulty : {0.0, 0.5, 1.0}) {
      spec_.difficulty = difficulty;
      Load(place);
      EXPECT_GT(SolidGeoms(), last) << place << " at " << difficulty;
      last = SolidGeoms();
    }
  }
}

TEST_F(PlacesTest, AnApartmentHasWallsAndItsDoorsStayOpen) {
  constexpr double kLow = 0.08;  // m, lower than all that stands about
  spec_.difficulty = 1;
  for (spec_.seed = 1; spec_.seed < 40; ++spec_.seed) {
    Load("apartment");
    EXPECT_NEAR(Sight(2.7, 0, 2, 1, 0), 0.24, 1e-6);  // the wall to the bedroom
    for (const double aside : {-0.4, 0.0, 0.4}) {
      ASSERT_GT(Sight(1.5 + aside, -1.4, kLow, 0, -1), 1) << spec_.seed;   // to the hall
      ASSERT_GT(Sight(2.4, 1.6 + aside, kLow, 1, 0), 1.2) << spec_.seed;   // to the kitchen
      ASSERT_GT(Sight(1.2 + aside, -3.2, kLow, 0, -1), 50) << spec_.seed;  // into the open
    }
    ASSERT_NEAR(Sight(1.5, -1.5, 2.3, 0, -1), 0.44, 1e-6) << "over the door";
  }
}

TEST_F(PlacesTest, WhatIsPaintedIsSeenAndNotTouched) {
  for (const std::string& place : PlaceNames()) {
    std::array<char, 200> error{};
    const std::string file = Write(place) / "scene.xml";
    model_.reset(mj_loadXML(file.c_str(), nullptr, error.data(), error.size()));
    ASSERT_NE(model_, nullptr) << error.data();
    const int floor = mj_name2id(model_.get(), mjOBJ_GEOM, "floor");
    EXPECT_TRUE(Solid(floor));
    int sheets = 0;
    for (int geom = 0; geom < model_->ngeom; ++geom) {
      if (model_->geom_type[geom] != mjGEOM_PLANE || geom == floor) continue;
      ++sheets;
      EXPECT_FALSE(Solid(geom)) << place;
      EXPECT_EQ(model_->geom_rgba[4 * geom + 3], 1) << place;
    }
    EXPECT_GT(sheets, 0) << place;
  }
}

TEST_F(PlacesTest, AStreetHasKerbsAndRampsAtTheCrossing) {
  spec_.difficulty = 0;
  Load("street");
  for (const double side : {-1.0, 1.0}) {
    EXPECT_NEAR(Height(0, side * 3.1), 0, 1e-6);
    EXPECT_NEAR(Height(0, side * 3.3), 0.12, 1e-6);
    EXPECT_NEAR(Height(4, side * (3.2 + 0.24)), 0.03, 1e-6);
    EXPECT_NEAR(Height(4, side * (3.2 + 0.72)), 0.09, 1e-6);
    EXPECT_NEAR(Height(4, side * (3.2 + 1.2)), 0.12, 1e-6);
  }
}

TEST_F(PlacesTest, AStreetHasBoxesOnItsPavement) {
  const auto covered = [&](double difficulty) {
    spec_.difficulty = difficulty;
    Load("street");
    int points = 0;
    for (double x = -12; x < 24; x += 0.1) {
      for (double y = 3.6; y < 5; y += 0.1) {
        points += Height(x, y) > 0.2 && Height(x, y) < 0.73 ? 1 : 0;
      }
    }
    return points;
  };
  EXPECT_GT(covered(1), covered(0) + 50);
}

TEST_F(PlacesTest, HaveLooseThingsOnFreeFloorApartFromEachOther) {
  constexpr double kUnderTables = 0.65, kRug = 0.015;  // m
  spec_.clutter = 1;
  spec_.difficulty = 1;
  for (const std::string& place : PlaceNames()) {
    for (spec_.seed = 1; spec_.seed < 6; ++spec_.seed) {
      Load(place);
      const std::vector<LooseThing> things = LooseThings(place, spec_);
      ASSERT_GE(things.size(), 3U) << place << " " << spec_.seed;
      for (std::size_t i = 0; i < things.size(); ++i) {
        const LooseThing& one = things[i];
        const mjtNum from[3] = {one.x, one.y, kUnderTables}, down[3] = {0, 0, -1};
        const double way = CastRay(mj_ray, model_.get(), data_.get(), from, down);
        EXPECT_NEAR(kUnderTables - way, one.z, kRug) << place << " " << one.kind;
        for (std::size_t other = 0; other < i; ++other) {
          EXPECT_GT(std::hypot(one.x - things[other].x, one.y - things[other].y), 0.07) << place;
        }
      }
    }
  }
}

TEST_F(PlacesTest, HaveAsManyLooseThingsAsAskedAndMoveNothingElseForThem) {
  const auto count = [&](double clutter) {
    spec_.clutter = clutter;
    return LooseThings("office", spec_).size();
  };
  EXPECT_EQ(count(0), 0U);
  EXPECT_LT(count(0.4), count(1));
  EXPECT_LE(count(1), 12U);
  const std::string with = Bytes(Write("office", "with") / "scene.xml");
  spec_.clutter = 0;
  EXPECT_EQ(Bytes(Write("office", "without") / "scene.xml"), with);
  spec_.clutter = 1;
  EXPECT_TRUE(LooseThings("rough", spec_).empty());
}

TEST_F(PlacesTest, RubAsMuchAsAsked) {
  spec_.friction = 0.3;
  for (const std::string& place : PlaceNames()) {
    Load(place);
    for (int geom = 0; geom < model_->ngeom; ++geom) {
      if (Solid(geom)) {
        ASSERT_EQ(model_->geom_friction[3 * geom], 0.3) << place;
      }
    }
  }
}

TEST_F(PlacesTest, CarryARobotThatMeetsTheFloorAlone) {
  const std::filesystem::path root = UNDERSTUDY_SOURCE_DIR;
  spec_.difficulty = 1;
  for (const char* name : {"go2", "g1"}) {
    const config::Config config =
        config::LoadConfig({.robot = name, .files = {}, .sets = {}}, root);
    const robot::RobotSpec& spec = config.robots[0].spec;
    for (const std::string& place : PlaceNames()) {
      physics::MujocoWorld world{physics::LoadWorldModel({{spec, root / "models" / spec.model}},
                                                         Write(place) / "scene.xml", 0.001),
                                 {{spec}}};
      const int floor = mj_name2id(&world.model(), mjOBJ_GEOM, "floor");
      world.robot().Reset(spec.lying);
      const std::vector<double> tau(world.robot().q().size());
      int touching = 0;
      for (int i = 0; i < 200; ++i) {
        world.BeginStep();
        world.robot().Drive(tau);
        ASSERT_EQ(world.EndStep(), physics::StepHealth::kFine) << name << " in " << place;
        for (int c = 0; c < world.data().ncon; ++c) {
          const mjContact& contact = world.data().contact[c];
          const int body1 = world.model().geom_bodyid[contact.geom1];
          const int body2 = world.model().geom_bodyid[contact.geom2];
          const bool itself =
              world.model().body_weldid[body1] != 0 && world.model().body_weldid[body2] != 0;
          if (itself) continue;
          ++touching;
          ASSERT_TRUE(contact.geom1 == floor || contact.geom2 == floor) << name << " in " << place;
        }
      }
      EXPECT_GT(touching, 0) << name << " in " << place;
    }
  }
}

TEST_F(PlacesTest, AreNoPatchesOfARow) {
  spec_.patches = {{.kind = "office"}};
  EXPECT_EQ(Refusal("row"), "no kind of terrain 'office'");
}

TEST_F(PlacesTest, HaveARowInTheDocument) {
  const std::string document = Bytes(UNDERSTUDY_SOURCE_DIR "/docs/reference/terrain.md");
  for (const std::string& place : PlaceNames()) {
    EXPECT_THAT(document, HasSubstr("\n| `" + place + "` | "));
  }
}

}  // namespace
}  // namespace understudy::terrain
