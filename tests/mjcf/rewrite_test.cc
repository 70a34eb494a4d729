#include "mjcf/rewrite.h"

#include <cmath>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "mjcf/compile.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::mjcf {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<double> Numbers(const mjtNum* x, int count) { return {x, x + count}; }

// The leg of tests/data/mujoco3_leg.xml, rewritten. What is rewritten loads in MuJoCo 3 as well.
class RewrittenLegTest : public test::MujocoTest {
 protected:
  RewrittenLegTest() {
    RewriteForMujoco2(&root_, &rewrites_);
    model_ = CompileMjcf(root_);
  }

  int Id(mjtObj type, const char* name) const { return mj_name2id(model_.get(), type, name); }
  std::vector<double> ForceRange(int actuator) const {
    EXPECT_TRUE(model_->actuator_forcelimited[actuator]);
    return Numbers(model_->actuator_forcerange + 2 * actuator, 2);
  }
  int SensorType(const char* name) const { return model_->sensor_type[Id(mjOBJ_SENSOR, name)]; }

  // The rewrite whose text has `what`; a failure and an empty one where there is none.
  Rewrite Find(const std::string& what) const {
    for (const Rewrite& rewrite : rewrites_) {
      if (rewrite.what.find(what) != std::string::npos) return rewrite;
    }
    ADD_FAILURE() << "no rewrite says " << what;
    return {};
  }

  MjcfElement root_ = ReadMjcf(test::FixtureFile("mujoco3_leg.xml"));
  std::vector<Rewrite> rewrites_;
  ModelHandle model_;
};

TEST_F(RewrittenLegTest, LimitsTheMotorByItsJointsOwnRange) {
  EXPECT_THAT(ForceRange(0), ElementsAre(-8, 9));
}

TEST_F(RewrittenLegTest, ReadsAKeyframeWhoseNumbersEndInSpaces) {
  const std::size_t size = static_cast<std::size_t>(model_->nq);
  std::string zeros = "\n";
  for (std::size_t i = 0; i < size; ++i) zeros += "0 ";
  MjcfElement keyframe{"keyframe", {}, {{"key", {{"qpos", zeros + "\n"}}, {}, {}}}, {}};
  root_.children.push_back(keyframe);
  RewriteForMujoco2(&root_, &rewrites_);
  EXPECT_EQ(CompileMjcf(root_)->nkey, 1);
}

TEST_F(RewrittenLegTest, DividesAnInheritedRangeByTheGearOfTheMotorsClass) {
  EXPECT_THAT(ForceRange(1), ElementsAre(-7.5, 2.5));  // -10..30 over -4
}

TEST_F(RewrittenLegTest, TakesTheNarrowerOfTwoRanges) {
  EXPECT_THAT(ForceRange(2), ElementsAre(-50, 20));
}

TEST_F(RewrittenLegTest, LeavesAJointAloneThatIsSaidNotToBeLimited) {
  EXPECT_FALSE(model_->actuator_forcelimited[3]);
}

TEST_F(RewrittenLegTest, SpellsOutThePositionServo) {
  // Inertia of the toe and what hangs on it: 4 + 1; kv = 2 * 0.5 * sqrt(9 * 5).
  EXPECT_THAT(Numbers(model_->actuator_gainprm + 4 * mjNGAIN, 1), ElementsAre(9));
  const std::vector<double> bias = Numbers(model_->actuator_biasprm + 4 * mjNBIAS, 3);
  EXPECT_THAT(bias, ElementsAre(0, -9, testing::DoubleNear(-std::sqrt(45.0), 1e-9)));
  EXPECT_EQ(model_->actuator_biastype[4], mjBIAS_AFFINE);
  // Half of -1..3 around its middle.
  EXPECT_TRUE(model_->actuator_ctrllimited[4]);
  EXPECT_THAT(Numbers(model_->actuator_ctrlrange + 8, 2), ElementsAre(0, 2));
}

TEST_F(RewrittenLegTest, TakesARangeForALimit) {
  EXPECT_TRUE(model_->jnt_limited[Id(mjOBJ_JOINT, "servo")]);
  EXPECT_FALSE(model_->jnt_limited[Id(mjOBJ_JOINT, "own")]);
}

TEST_F(RewrittenLegTest, KeepsTheLayoutOfSensordata) {
  EXPECT_EQ(model_->nsensor, 7);
  EXPECT_EQ(model_->nsensordata, 9);
  EXPECT_EQ(model_->sensor_adr[Id(mjOBJ_SENSOR, "gyro")], 6);
}

TEST_F(RewrittenLegTest, ReadsTheTorqueOfAJointAtItsMotor) {
  const int sensor = Id(mjOBJ_SENSOR, "own_tau");
  EXPECT_EQ(model_->sensor_type[sensor], mjSENS_ACTUATORFRC);
  EXPECT_EQ(model_->sensor_objid[sensor], Id(mjOBJ_ACTUATOR, "own"));
  EXPECT_EQ(model_->sensor_noise[sensor], 0.5);
  EXPECT_EQ(SensorType("strong_tau"), mjSENS_ACTUATORFRC);
  EXPECT_EQ(SensorType("unlimited_tau"), mjSENS_ACTUATORFRC);
}

TEST_F(RewrittenLegTest, KeepsThePlaceOfASensorThatNoMotorCanStandFor) {
  EXPECT_EQ(SensorType("inherited_tau"), mjSENS_USER);  // gear -4
  EXPECT_EQ(SensorType("idle_tau"), mjSENS_USER);       // no motor
}

TEST_F(RewrittenLegTest, GivesTheForceOfTheLimitedMotor) {
  const DataHandle data(mj_makeData(model_.get()));
  data->ctrl[0] = 100;
  data->ctrl[1] = 100;
  mj_forward(model_.get(), data.get());
  const auto torque = [&](const char* joint) {
    return data->qfrc_actuator[model_->jnt_dofadr[Id(mjOBJ_JOINT, joint)]];
  };
  EXPECT_EQ(torque("own"), 9);
  EXPECT_EQ(torque("inherited"), -10);  // 2.5 times -4
  EXPECT_EQ(data->sensordata[model_->sensor_adr[Id(mjOBJ_SENSOR, "own_tau")]], 9);
}

TEST_F(RewrittenLegTest, FindsMeshesBesideTheFile) { EXPECT_EQ(model_->nmesh, 1); }

TEST_F(RewrittenLegTest, NamesFileAndLineOfEachRewrite) {
  const std::string file = test::FixtureFile("mujoco3_leg.xml");
  const Rewrite own = Find("actuatorfrcrange -8 9 of joint 'own'");
  EXPECT_EQ(own.place.file, file);
  EXPECT_EQ(own.place.line, 24);
  EXPECT_THAT(own.text(), AllOf(HasSubstr(file + ":24: "), HasSubstr("forcerange -8 9"),
                                HasSubstr("2.2.2 limits actuators")));
}

TEST_F(RewrittenLegTest, ReportsWhatItLeavesOut) {
  for (const char* what :
       {"content_type", "ls_iterations", "eulerdamp", "implicitfast became implicit", "autolimits",
        "<light> type=\"directional\"", "of joint 'idle' left out", "of joint 'unlimited' left out",
        "a user sensor that reads 0"}) {
    Find(what);
  }
  EXPECT_EQ(model_->opt.integrator, mjINT_IMPLICIT);
}

class MjcfRewriteTest : public test::MujocoTest {
 protected:
  // Rewrites a model with these elements; the refusal, or "" when it went well.
  std::string Refusal(const std::string& elements) {
    const auto file = folder_.Write("robot.xml", "<mujoco>\n" + elements + "\n</mujoco>");
    rewrites_.clear();
    try {
      MjcfElement root = ReadMjcf(file);
      RewriteForMujoco2(&root, &rewrites_);
      model_ = CompileMjcf(root);
    } catch (const ModelError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    return "";
  }

  // A body with the joint on line 2 and its actuators on line 3.
  static std::string Body(const std::string& joint, const std::string& rest) {
    return "<worldbody><body><joint name='knee' " + joint +
           "/><geom size='.1'/></body></worldbody>\n" + rest;
  }

  test::TemporaryFolder folder_;
  std::vector<Rewrite> rewrites_;
  ModelHandle model_;
};

TEST_F(MjcfRewriteTest, LeavesAFileOfMujoco2AsItIs) {
  EXPECT_EQ(Refusal("<compiler autolimits='true'/>" +
                    Body("range='0 1'",
                         "<actuator><motor joint='knee' ctrllimited='true' "
                         "ctrlrange='-1 1'/></actuator>")),
            "");
  EXPECT_THAT(rewrites_, IsEmpty());
}

TEST_F(MjcfRewriteTest, ConvertsAnInheritedRangeFromDegrees) {
  EXPECT_EQ(Refusal(Body("range='-90 90'",
                         "<actuator><position joint='knee' kv='3' inheritrange='1'/></actuator>")),
            "");
  EXPECT_NEAR(model_->actuator_ctrlrange[1], std::acos(-1) / 2, 1e-15);
  EXPECT_EQ(model_->actuator_biasprm[1], -1);  // kp is 1 by default
  EXPECT_EQ(model_->actuator_biasprm[2], -3);
}

TEST_F(MjcfRewriteTest, GivesAMotorANameThatASensorNeeds) {
  EXPECT_EQ(Refusal(Body("",
                         "<actuator><motor joint='knee'/></actuator>"
                         "<sensor><jointactuatorfrc joint='knee'/></sensor>")),
            "");
  EXPECT_EQ(mj_name2id(model_.get(), mjOBJ_ACTUATOR, "understudy_knee"), 0);
}

TEST_F(MjcfRewriteTest, RefusesWithItsPlaceWhatCannotBeCarriedOut) {
  const std::string limited = "actuatorfrcrange='-1 1'";
  const std::string tendon =
      "<tendon><fixed name='t'><joint joint='knee' coef='1'/></fixed></tendon>";
  const std::pair<std::string, std::vector<std::string>> rows[] = {
      // A limited joint that two motors or a tendon move.
      {Body(limited,
            "<actuator><motor name='a' joint='knee'/>\n<motor name='b' joint='knee'/></actuator>"),
       {"robot.xml:2: joint 'knee'", "'a'", "'b' (" + (folder_.path() / "robot.xml:4").string()}},
      {Body(limited, tendon + "<actuator><motor name='puller' tendon='t'/></actuator>"),
       {"joint 'knee'", "'puller'"}},
      {Body(limited, "<actuator><motor name='a' joint='knee' gear='0'/></actuator>"),
       {"robot.xml:3: ", "'a' has gear 0"}},
      {Body(limited, "<actuator><motor joint='knee' forcerange='2 3'/></actuator>"),
       {"robot.xml:3: ", "no force in common"}},
      {"<sensor><jointactuatorfrc joint='kneee'/></sensor>", {"robot.xml:2: no joint 'kneee'"}},
      {Body("", "<actuator><position joint='knee' inheritrange='1'/></actuator>"),
       {"robot.xml:3: inheritrange"}},
      {"<default><default class='a'><default class='a'/></default></default>",
       {"robot.xml:2: ", "'a'"}},
      {"<worldbody>\n<body>\n<geom size='-1'/></body></worldbody>", {"robot.xml:4: "}},
  };
  for (const auto& [elements, words] : rows) {
    for (const std::string& word : words) {
      EXPECT_THAT(Refusal(elements), HasSubstr(word)) << elements;
    }
  }
}

TEST_F(MjcfRewriteTest, RefusesARangeThatIsNone) {
  for (const char* range : {"1", "1 x", "2 1", "1 1", "nan 1", "-inf inf", "1 2 3", ""}) {
    EXPECT_THAT(Refusal(Body("actuatorfrcrange='" + std::string(range) + "'", "")),
                AllOf(HasSubstr("robot.xml:2: actuatorfrcrange=\""), HasSubstr("expected")))
        << range;
  }
}

#if mjVERSION_HEADER < 300  // words that only one of the two knows
TEST_F(MjcfRewriteTest, CallsASettingByItsOldName) {
  EXPECT_EQ(Refusal("<option ccd_iterations='35'/>"), "");
  EXPECT_EQ(model_->opt.mpr_iterations, 35);
}

TEST_F(MjcfRewriteTest, ListsEveryWordThatIsUnknown) {
  const auto file = folder_.Write("robot.xml",
                                  "<mujoco>\n<worldbody>\n<body gravcomp='1'><geom size='1'/>\n"
                                  "<frame><geom sise='1'/></frame></body></worldbody></mujoco>");
  EXPECT_THAT(UnknownWords(ReadMjcf(file)),
              ElementsAre(AllOf(HasSubstr("robot.xml:3: "), HasSubstr("'gravcomp'")),
                          AllOf(HasSubstr("robot.xml:4: "), HasSubstr("'frame'"))));
  EXPECT_THAT(UnknownWords(ReadMjcf(folder_.Write("fine.xml", "<mujoco/>"))), IsEmpty());
  EXPECT_THAT(UnknownWords(ReadMjcf(folder_.Write(
                  "wrong.xml", "<mujoco><worldbody><geom size='-1'/></worldbody></mujoco>"))),
              IsEmpty());
}

TEST_F(MjcfRewriteTest, RefusesByNameWhatItCannotCarryOver) {
  EXPECT_THAT(Refusal("<worldbody>\n<body gravcomp='1'><geom size='1'/></body></worldbody>"),
              AllOf(HasSubstr("robot.xml:3: "), HasSubstr("'gravcomp'"), HasSubstr("'body'"),
                    HasSubstr("unknown to MuJoCo 2.2.2")));
}
#endif

}  // namespace
}  // namespace understudy::mjcf
