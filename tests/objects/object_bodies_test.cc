#include "objects/object_bodies.h"

#include <cmath>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "mjcf/compile.h"
#include "objects/prints.h"
#include "tests/support/error_of.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::objects {
namespace {

using mjcf::MjcfElement;

MjcfElement Element(const std::string& name,
                    std::vector<std::pair<std::string, std::string>> attributes,
                    std::vector<MjcfElement> children = {}) {
  return {.name = name,
          .attributes = std::move(attributes),
          .children = std::move(children),
          .place = {}};
}

class ObjectBodiesTest : public test::MujocoTest {
 protected:
  // On a floor, beside `others`.
  void Make(const std::vector<ObjectSpec>& objects, std::vector<MjcfElement> others = {}) {
    MjcfElement root = Element("mujoco", {}, std::move(others));
    root.children.push_back(
        Element("worldbody", {}, {Element("geom", {{"type", "plane"}, {"size", "0 0 1"}})}));
    root.children.push_back(MakeObjectBodies(objects, Prints::kLeftOut));
    model_ = mjcf::CompileMjcf(root);
    data_.reset(mj_makeData(model_.get()));
    mj_forward(model_.get(), data_.get());
  }
  void Pass(double seconds) {
    while (data_->time < seconds) mj_step(model_.get(), data_.get());
  }
  int Body(const char* name) const { return mj_name2id(model_.get(), mjOBJ_BODY, name); }
  double Height(const char* name) const { return data_->xpos[3 * Body(name) + 2]; }
  double Upright(const char* name) const { return data_->xmat[9 * Body(name) + 8]; }

  mjcf::ModelHandle model_;
  mjcf::DataHandle data_;
};

TEST_F(ObjectBodiesTest, StandWhereTheyWerePut) {
  for (const ObjectKind& kind : ObjectKinds()) {
    Make({{.kind = std::string(kind.name), .name = "it", .pos = {1, 2, 0.001}, .yaw = 0.5}});
    Pass(1);
    const mjtNum* const at = data_->xpos + 3 * Body("it");
    EXPECT_NEAR(at[0], 1, 1e-3) << kind.name;
    EXPECT_NEAR(at[1], 2, 1e-3) << kind.name;
    EXPECT_NEAR(at[2], kind.height / 2, 2e-3) << kind.name;
    EXPECT_GT(Upright("it"), 0.999) << kind.name;
    EXPECT_NEAR(data_->xmat[9 * Body("it")], std::cos(0.5), 1e-2) << kind.name;
  }
}

TEST_F(ObjectBodiesTest, WeighWhatTheirKindDoesOrTheySay) {
  for (const ObjectKind& kind : ObjectKinds()) {
    if (kind.fixed()) continue;
    Make({{.kind = std::string(kind.name)}, {.kind = std::string(kind.name), .mass = 7}});
    EXPECT_NEAR(model_->body_mass[1], kind.mass, 1e-6 * kind.mass) << kind.name;
    EXPECT_NEAR(model_->body_mass[2], 7, 1e-5) << kind.name;
  }
}

TEST_F(ObjectBodiesTest, RubAsTheirKindDoesOrTheySay) {
  Make({{.kind = "cube"}, {.kind = "cube", .friction = 0.25}});
  EXPECT_EQ(model_->geom_friction[3 * model_->body_geomadr[1]], 0.6);
  EXPECT_EQ(model_->geom_friction[3 * model_->body_geomadr[2]], 0.25);
}

TEST_F(ObjectBodiesTest, HavePrintsThatNothingMeetsWhereTheyAreAskedFor) {
  const std::vector<ObjectSpec> tag{{.kind = "tag", .id = 3}};
  EXPECT_EQ(MakeObjectBodies(tag, Prints::kLeftOut).children[0].children.size(), 1U);
  const MjcfElement body = MakeObjectBodies(tag, Prints::kKept).children[0];
  EXPECT_EQ(body.children.size(), 1 + PrintsOf(tag[0]).size());
  for (std::size_t i = 1; i < body.children.size(); ++i) {
    EXPECT_EQ(body.children[i].Get("contype") + body.children[i].Get("conaffinity"), "00");
  }
}

TEST_F(ObjectBodiesTest, StandOnATable) {
  Make({{.kind = "table", .pos = {1, 0, 0}}, {.kind = "cube", .pos = {0.9, 0.3, 0.751}}});
  Pass(1);
  EXPECT_EQ(model_->nv, 6) << "a table does not move";
  EXPECT_NEAR(Height("cube"), 0.775, 2e-3);
}

TEST_F(ObjectBodiesTest, HaveNothingOfARobotsDefaults) {
  const std::vector<ObjectSpec> objects{{.kind = "cup"}, {.kind = "ball"}};
  Make(objects);
  const mjcf::ModelHandle plain = std::move(model_);
  Make(objects, {Element("default", {},
                         {Element("geom", {{"contype", "0"},
                                           {"conaffinity", "0"},
                                           {"condim", "1"},
                                           {"group", "3"},
                                           {"priority", "2"},
                                           {"friction", "2 2 2"},
                                           {"solref", "0.5 1"},
                                           {"solimp", "0.1 0.2 0.3"},
                                           {"margin", "0.1"},
                                           {"gap", "0.1"},
                                           {"solmix", "3"},
                                           {"density", "1"},
                                           {"rgba", "0 0 0 0"}}),
                          Element("joint", {{"damping", "9"}, {"armature", "9"}})})});
  for (int geom = 1; geom < model_->ngeom; ++geom) {
    const auto same = [&](const auto* mine, const auto* theirs, int count) {
      return std::equal(mine + count * geom, mine + count * (geom + 1), theirs + count * geom);
    };
    EXPECT_TRUE(same(model_->geom_contype, plain->geom_contype, 1));
    EXPECT_TRUE(same(model_->geom_conaffinity, plain->geom_conaffinity, 1));
    EXPECT_TRUE(same(model_->geom_condim, plain->geom_condim, 1));
    EXPECT_TRUE(same(model_->geom_group, plain->geom_group, 1));
    EXPECT_TRUE(same(model_->geom_priority, plain->geom_priority, 1));
    EXPECT_TRUE(same(model_->geom_friction, plain->geom_friction, 3));
    EXPECT_TRUE(same(model_->geom_solref, plain->geom_solref, mjNREF));
    EXPECT_TRUE(same(model_->geom_solimp, plain->geom_solimp, mjNIMP));
    EXPECT_TRUE(same(model_->geom_margin, plain->geom_margin, 1));
    EXPECT_TRUE(same(model_->geom_gap, plain->geom_gap, 1));
    EXPECT_TRUE(same(model_->geom_solmix, plain->geom_solmix, 1));
    EXPECT_TRUE(same(model_->geom_rgba, plain->geom_rgba, 4));
  }
  EXPECT_TRUE(std::equal(model_->body_mass, model_->body_mass + 3, plain->body_mass));
  EXPECT_EQ(*std::max_element(model_->dof_armature, model_->dof_armature + model_->nv), 0);
  EXPECT_EQ(*std::max_element(model_->dof_damping, model_->dof_damping + model_->nv), 0);
}

TEST_F(ObjectBodiesTest, HaveABallThatComesToRest) {
  Make({{.kind = "ball"}});
  data_->qvel[0] = 1;
  Pass(1);
  EXPECT_GT(data_->qpos[0], 0.5) << "it rolls";
  Pass(30);
  EXPECT_LT(std::abs(data_->qvel[0]), 0.01);
}

TEST_F(ObjectBodiesTest, RequireAPngOfAPoster) {
  const test::TemporaryFolder folder;
  const std::string png = folder.Write("cat.png", "\x89PNG\r\n\x1a\n and so on");
  EXPECT_NO_THROW(RequirePictures(std::vector<ObjectSpec>{{.kind = "poster", .image = png}}));
  for (const std::string& image :
       {std::string("/dev/zero"), folder.Write("cat.jpg", "JFIF").string()}) {
    const std::vector<ObjectSpec> objects{{}, {.kind = "poster", .image = image}};
    EXPECT_EQ(test::ErrorOf<ModelError>([&] { RequirePictures(objects); }),
              "objects.1.image: expected a PNG, got '" + image + "'");
  }
}

}  // namespace
}  // namespace understudy::objects
