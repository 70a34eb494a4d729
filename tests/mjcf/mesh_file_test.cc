#include "mjcf/mesh_file.h"

#include <bit>
#include <cstdint>
#include <cstring>

#include <gmock/gmock.h>

#include "base/errors.h"
#include "mjcf/stl.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace understudy::mjcf {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

// A square of two triangles, and what readers make of it.
const std::vector<float> kSquareCorners{0, 0, 1, 2, 0, 1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 2, 1};
constexpr char kSquareObj[] =
    "# square\nv 0 0 1\nv 2 0 1\nv 2 2 1\nv 0 2 1\nvn 0 0 1\nf 1/1/1 2//1 3 4\n";
constexpr char kPlyHead[] =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
constexpr char kSquareStl[] =
    "solid square\n"
    "facet normal 0 0 1\n outer loop\n vertex 0 0 1\n vertex 2 0 1\n vertex 2 2 1\n "
    "endloop\nendfacet\n"
    "facet normal 0 0 1\n outer loop\n vertex 0 0 1\n vertex 2 2 1\n vertex 0 2 1\n "
    "endloop\nendfacet\n"
    "endsolid\n";

std::string PlyText() {
  return std::string("ply\nformat ascii 1.0\ncomment a square\n") + kPlyHead +
         "0 0 1\n2 0 1\n2 2 1\n0 2 1\n4 0 1 2 3\n";
}

template <class T>
std::string Bytes(T value, bool big) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return big ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

std::string PlyBytes(bool big) {
  std::string text =
      std::string("ply\r\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + kPlyHead;
  for (const float x : {0.F, 0.F, 1.F, 2.F, 0.F, 1.F, 2.F, 2.F, 1.F, 0.F, 2.F, 1.F})
    text += Bytes(x, big);
  text += '\4';
  for (const std::int32_t i : {0, 1, 2, 3}) text += Bytes(i, big);
  return text;
}

class MeshFileTest : public testing::Test {
 protected:
  std::vector<MeshPart> Read(const std::string& name, const std::string& text) {
    return ReadMeshFile(folder_.Write(name, text));
  }
  std::string Fault(const std::string& name, const std::string& text) {
    return test::ErrorOf<ModelError>([&] { Read(name, text); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(MeshFileTest, ReadsTheSameSquareFromEachKindOfFile) {
  const std::pair<const char*, std::string> files[] = {
      {"a.obj", kSquareObj},       {"a.ply", PlyText()},  {"little.ply", PlyBytes(false)},
      {"big.PLY", PlyBytes(true)}, {"a.stl", kSquareStl}, {"binary.stl", Stl(kSquareCorners)},
  };
  for (const auto& [name, text] : files) {
    const std::vector<MeshPart> parts = Read(name, text);
    ASSERT_THAT(parts, SizeIs(1)) << name;
    EXPECT_EQ(parts[0].corners, kSquareCorners) << name;
    EXPECT_EQ(parts[0].rgba, std::nullopt) << name;
  }
}

TEST_F(MeshFileTest, SaysWhichKindsItReads) {
  EXPECT_THAT(MeshExtensions(), ElementsAre(".dae", ".obj", ".ply", ".stl"));
  EXPECT_TRUE(IsMeshFile("a.b/Office.OBJ"));
  EXPECT_FALSE(IsMeshFile("office"));
  EXPECT_THAT(Fault("a.glb", ""), HasSubstr("a.glb: expected one of .dae, .obj, .ply, .stl"));
}

TEST_F(MeshFileTest, ReadsAllObjectsOfAnObjAndCountsBackFromItsEnd) {
  const std::vector<MeshPart> parts =
      Read("a.obj", "o one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no two\nv 0 0 5\nf -1 -3 -2\n");
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_THAT(parts[0].corners, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 5, 1, 0, 0, 0, 1, 0));
}

TEST_F(MeshFileTest, PaintsAnObjByItsMaterialsOrItsVertices) {
  folder_.Write("room.mtl", "newmtl oak\nKd 0.5 0.25 0\nnewmtl lime\nKd 1 1 1\n");
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  // Only the name of a path counts, which is that of another computer.
  std::vector<MeshPart> parts = Read("a.obj", "mtllib C/scans/room.mtl\n" + corners +
                                                  "usemtl oak\nf 1 2 3\nusemtl gold\nf 1 3 2\n");
  ASSERT_THAT(parts, SizeIs(2));
  EXPECT_EQ(parts[0].rgba, std::nullopt);
  EXPECT_EQ(parts[1].rgba, (std::array{0.5, 0.25, 0.0, 1.0}));
  parts = Read("b.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0.1 0\nf 1 2 3\n");
  EXPECT_EQ(parts[0].rgba, (std::array{1.0, 0.0, 0.0, 1.0}));
}

TEST_F(MeshFileTest, RoundsColoursOfAPlySoThatThereAreFewParts) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
      "element face 2\nproperty uchar flags\nproperty list uchar int vertex_index\nend_header\n"
      "0 0 0 255 0 60 9\n1 0 0 250 5 64 9\n0 1 0 252 0 70 9\n7 3 0 1 2\n7 3 2 1 0\n";
  const std::vector<MeshPart> parts = Read("a.ply", text);
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_EQ(parts[0].rgba, (std::array{1.0, 0.0, 0.25, 1.0}));
  EXPECT_THAT(parts[0].corners, SizeIs(18));
}

TEST_F(MeshFileTest, SaysWhatIsWrongAndWhere) {
  const std::string ply = PlyText();
  const auto with = [&](const std::string& old, const std::string& now) {
    return std::string(ply).replace(ply.find(old), old.size(), now);
  };
  const std::array<std::string, 3> faults[] = {
      {"a.obj", "v 0 0 0\nv 1 x 0\n", "a.obj:2: expected a number, not 'x'"},
      {"b.obj", "v 0 0 0\nf 1 2 3\n", "b.obj:2: no vertex 2: there are 1"},
      {"c.obj", "v 0 0 0\nf 1 1\n", "c.obj:2: expected three corners or more"},
      {"d.obj", "v 0 0 0\n", "d.obj: expected triangles"},
      {"e.obj", "v 0 0 2e6\nf 1 1 1\n", "e.obj: a corner at 2e+06"},
      {"a.ply", "solid", "a.ply:1: expected 'ply'"},
      {"b.ply", with("ascii", "ascii2"), "b.ply:2: expected format ascii, binary_little_endian"},
      {"c.ply", with("float", "half"), "c.ply:5: expected a kind of number, not 'half'"},
      {"d.ply", with("4 0 1 2 3", "4 0 1 2 9"), "d.ply: no vertex 9: there are 4"},
      {"e.ply", with("4 0 1 2 3", "4 0 1"), "expected a number"},
      {"f.ply", with("end_header", "end"), "expected 'end_header'"},
      {"g.ply", PlyBytes(false).substr(0, PlyBytes(false).size() - 2), "g.ply: ends too early"},
      {"a.stl", "nothing", "a.stl: expected STL"},
      {"b.stl", Stl(kSquareCorners) + "x",
       "b.stl: expected STL, as text or with the bytes of 2 triangles"},
      {"c.stl", "solid\nvertex 1 2\n", "c.stl:2: expected a number"},
  };
  for (const auto& [name, text, says] : faults) {
    EXPECT_THAT(Fault(name, text), HasSubstr(says)) << name;
  }
}

TEST_F(MeshFileTest, AsksForFacesWhereAPlyHasPointsAlone) {
  const std::string text = PlyText();
  const std::size_t face = text.find("element face"), end = text.find("end_header");
  EXPECT_THAT(
      Fault("cloud.ply", text.substr(0, face) + text.substr(end, 11) + "0 0 0 1 1 1 2 2 2 3 3 3"),
      HasSubstr("has points and no faces; make a mesh of them first"));
}

TEST_F(MeshFileTest, DoesNotBelieveTheCountsOfAHead) {
  EXPECT_THAT(Fault("a.ply",
                    "ply\nformat binary_little_endian 1.0\nelement vertex 999999999999\nproperty "
                    "float x\nelement nothing 999999999999999\nend_header\n"),
              HasSubstr("ends too early"));
}

}  // namespace
}  // namespace understudy::mjcf
