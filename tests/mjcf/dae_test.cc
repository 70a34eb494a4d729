#include "mjcf/dae.h"

#include <cstring>

#include <gmock/gmock.h>

#include "base/errors.h"
#include "base/files.h"
#include "mjcf/urdf_reader.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace understudy::mjcf {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// In centimetres: a triangle, and a square of another colour, by a node that is turned and moved.
constexpr char kDae[] = R"(<COLLADA>
  <asset><unit meter="0.01"/><up_axis>Y_UP</up_axis></asset>
  <library_effects><effect id="red"><profile_COMMON><technique><phong>
    <diffuse><color>1 0.5 0 0.2</color></diffuse></phong></technique></profile_COMMON></effect></library_effects>
  <library_materials><material id="paint"><instance_effect url="#red"/></material></library_materials>
  <library_geometries><geometry id="g"><mesh>
    <source id="points"><float_array>0 0 0 100 0 0 100 100 0 0 100 0</float_array></source>
    <vertices id="v"><input semantic="POSITION" source="#points"/></vertices>
    <triangles material="m"><input semantic="NORMAL" offset="0"/>
      <input semantic="VERTEX" source="#v" offset="1"/><p>9 0 9 1 9 2</p></triangles>
    <polylist><input semantic="VERTEX" source="#v" offset="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s">
    <node id="n"><translate>0 0 100</translate><rotate>0 0 1 90</rotate>
      <node><instance_geometry url="#g"><bind_material><technique_common>
        <instance_material symbol="m" target="#paint"/></technique_common></bind_material>
      </instance_geometry></node></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

class DaeTest : public testing::Test {
 protected:
  static std::string With(const std::string& old, const std::string& now) {
    std::string text = kDae;
    return text.replace(text.find(old), old.size(), now);
  }
  std::vector<MeshPart> Read(const std::string& text = kDae) {
    return ReadDae(folder_.Write("a.dae", text));
  }
  std::string FaultOf(const std::string& text) {
    return test::ErrorOf<ModelError>([&] { Read(text); });
  }
  test::TemporaryFolder folder_;
};

// Near, since a quarter turn is not exact.
testing::Matcher<std::vector<float>> Corners(const std::vector<float>& expected) {
  return testing::Pointwise(testing::FloatNear(1e-6F), expected);
}

TEST_F(DaeTest, PutsTrianglesWhereNodesHaveThemInMetres) {
  const std::vector<MeshPart> parts = Read();
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_THAT(parts[0].corners, Corners({0, 0, 1, 0, 1, 1, -1, 1, 1}));
}

TEST_F(DaeTest, MakesAFanOfAPolygon) {
  EXPECT_THAT(Read()[1].corners,
              Corners({0, 0, 1, 0, 1, 1, -1, 1, 1, 0, 0, 1, -1, 1, 1, -1, 0, 1}));
}

TEST_F(DaeTest, GivesEachColourAPart) {
  const std::vector<MeshPart> parts = Read();
  EXPECT_EQ(parts[0].rgba, (std::array<double, 4>{1, 0.5, 0, 1}));
  EXPECT_EQ(parts[1].rgba, std::nullopt);
}

TEST_F(DaeTest, TurnsTheFacesOfAMirrorImageRound) {
  EXPECT_THAT(Read(With("<rotate>0 0 1 90</rotate>", "<scale>-1 1 1</scale>"))[0].corners,
              Corners({0, 0, 1, -1, 1, 1, -1, 0, 1}));
}

TEST_F(DaeTest, ReadsMatricesByRows) {
  EXPECT_THAT(
      Read(With("<rotate>0 0 1 90</rotate>", "<matrix>1 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1</matrix>"))[0]
          .corners,
      Corners({0.05F, 0.06F, 1.07F, 1.05F, 0.06F, 1.07F, 1.05F, 1.06F, 1.07F}));
}

TEST_F(DaeTest, SaysWhereAFileIsWrong) {
  const std::pair<std::string, std::string> wrong[] = {
      {"<COLLADA", "not XML"},
      {"<!-- nothing -->", "expected COLLADA, found no element"},
      {With("0 0 0 100", "1e300 0 0 100"), "a vertex beyond 1000 km"},
      {"<mujoco/>", "a.dae:1: expected COLLADA, not <mujoco>"},
      {"<COLLADA/>", "expected a <visual_scene>"},
      {With("url=\"#g\"", "url=\"#h\""), "nothing has the id '#h'"},
      {With("9 0 9 1 9 2", "9 0 9 1 9 4"), "a.dae:10: vertex 4: there are 4"},
      {With("9 0 9 1 9 2", "9 0 9 1 9 -2"), "a.dae:10: <p>: expected numbers"},
      {With("0 0 0 100", "0 0 nan 100"), "<float_array>: expected numbers"},
      {With("<vcount>4", "<vcount>5"), "fewer corners than its faces need"},
      {With("<rotate>0 0 1 90", "<rotate>0 0 1"), "expected 4 numbers"},
      {With("<node>", "<node><instance_node url=\"#n\"/>"), "more than 50 levels of nodes"},
      {With("meter=\"0.01\"", "meter=\"0\""), "expected a length above 0"},
      {With("<triangles", "<tristrips/><triangles"), "<tristrips>: expected triangles"},
  };
  for (const auto& [text, said] : wrong) EXPECT_THAT(FaultOf(text), HasSubstr(said)) << text;
}

// 24 nodes that each name the next one twice have millions of squares, or of nothing at all.
TEST_F(DaeTest, EndsWhereNodesMultiply) {
  std::string nodes;
  for (int i = 0; i < 24; ++i) {
    const std::string next = i == 23 ? "n" : "x" + std::to_string(i + 1);
    nodes += "<node id='x" + std::to_string(i) + "'><instance_node url='#" + next +
             "'/><instance_node url='#" + next + "'/></node>";
  }
  EXPECT_THAT(FaultOf(With("<node id=\"n\">", nodes + "<node id=\"n\">")),
              HasSubstr("more than 100000 nodes"));
}

constexpr char kBox[] = R"(<robot name="r"><link name="base">
  <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial>
  <visual><geometry><mesh filename="a.dae"/></geometry>
    <material name="x"><color rgba="0 0 1 1"/></material></visual>
  <collision><geometry><mesh filename="a.dae" scale="2 2 2"/></geometry></collision></link></robot>)";

TEST_F(DaeTest, BecomesAnStlForEachColourOfALink) {
  folder_.Write("a.dae", kDae);
  const UrdfRobot robot = ReadUrdf(folder_.Write("r.urdf", kBox));
  EXPECT_THAT(robot.notes, testing::IsEmpty());
  ASSERT_EQ(robot.meshes.size(), 2u);
  EXPECT_EQ(robot.meshes[0].to, "meshes/a.stl");
  EXPECT_EQ(robot.meshes[1].to, "meshes/2_a.stl");
  ASSERT_EQ(robot.meshes[0].stl.size(), 84u + 50);
  float x = 0;  // of the second corner's y, after the head, the normal and four numbers
  std::memcpy(&x, robot.meshes[0].stl.data() + 84 + 12 + 4 * sizeof x, sizeof x);
  EXPECT_NEAR(x, 1, 1e-6);

  std::vector<std::string> looks, collides;
  const MjcfElement& world = robot.model.children.back();
  for (const MjcfElement& geom : world.children[0].children) {
    if (geom.name != "geom") continue;
    if (geom.Get("class") == "visual") looks.push_back(geom.Get("rgba"));
    if (geom.Get("class") == "collision") collides.push_back(geom.Get("name"));
  }
  EXPECT_THAT(looks, ElementsAre("1 0.5 0 1", "0 0 1 1"));
  EXPECT_THAT(collides, ElementsAre("base_collision", "base_collision_2"));
}

TEST_F(DaeTest, IsPassedOverWhereALookCannotBeReadAndRefusedWhereItCollides) {
  folder_.Write("a.dae", With("9 0 9 1 9 2", "9 0 9 1 9 4"));
  const std::string urdf = kBox;
  const std::size_t at = urdf.find("<collision>");
  const std::string seen = urdf.substr(0, at) + "</link></robot>";
  const UrdfRobot robot = ReadUrdf(folder_.Write("r.urdf", seen));
  ASSERT_EQ(robot.notes.size(), 1u);
  EXPECT_THAT(robot.notes[0], testing::AllOf(HasSubstr("r.urdf:3: mesh a.dae:"),
                                             HasSubstr("vertex 4"), HasSubstr("mesh skipped")));
  EXPECT_THROW(ReadUrdf(folder_.Write("r.urdf", urdf)), ModelError);
}

}  // namespace
}  // namespace understudy::mjcf
