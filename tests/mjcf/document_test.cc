#include "mjcf/document.h"

#include <gmock/gmock.h>

#include "base/errors.h"
#include "mjcf/assets.h"
#include "tests/support/temporary_folder.h"

namespace understudy::mjcf {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

std::string Repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

class MjcfDocumentTest : public testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& text) {
    return folder_.Write(name, text).string();
  }

  // What reading the file refuses; "" when it is fine.
  static std::string Refusal(const std::filesystem::path& file) {
    try {
      RequireAssets(ReadMjcf(file));
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder folder_;
};

TEST_F(MjcfDocumentTest, PutsIncludesInPlace) {
  Write("b.xml", "<mujoco>\n<two/>\n<three/></mujoco>");
  const MjcfElement root =
      ReadMjcf(Write("a.xml", "<mujoco><one/>\n<include file='b.xml'/><four/></mujoco>"));
  ASSERT_EQ(root.children.size(), 4u);
  EXPECT_EQ(root.children[2].name, "three");
  EXPECT_THAT(root.children[2].place.text(), EndsWith("b.xml:3"));
  EXPECT_THAT(root.children[3].place.text(), EndsWith("a.xml:2"));
}

TEST_F(MjcfDocumentTest, LooksForNestedIncludesFromTheMainFileThenBesideTheAskingOne) {
  Write("parts/arm.xml", "<mujoco><include file='hand.xml'/><include file='foot.xml'/></mujoco>");
  Write("parts/hand.xml", "<mujoco><hand/></mujoco>");
  Write("foot.xml", "<mujoco><foot/></mujoco>");
  const MjcfElement root =
      ReadMjcf(Write("a.xml", "<mujoco><include file='parts/arm.xml'/></mujoco>"));
  ASSERT_EQ(root.children.size(), 2u);
  EXPECT_EQ(root.children[0].name, "hand");
  EXPECT_EQ(root.children[1].name, "foot");
}

TEST_F(MjcfDocumentTest, MakesAssetFilesAbsolute) {
  const std::string mesh = Write("meshes/a.obj", ""), texture = Write("pictures/b.png", "");
  const MjcfElement root =
      ReadMjcf(Write("a.xml",
                     "<mujoco><compiler meshdir='meshes' texturedir='pictures'/><asset>"
                     "<mesh file='a.obj'/><texture fileup='b.png'/></asset></mujoco>"));
  EXPECT_EQ(root.children[1].children[0].Get("file"), mesh);
  EXPECT_EQ(root.children[1].children[1].Get("fileup"), texture);
  EXPECT_EQ(root.children[0].Find("meshdir"), nullptr);
}

TEST_F(MjcfDocumentTest, StripsPathsWhereTheCompilerAsksForThat) {
  const std::string mesh = Write("meshes/a.obj", "");
  const MjcfElement root =
      ReadMjcf(Write("a.xml",
                     "<mujoco><compiler assetdir='meshes' strippath='true'/><asset>"
                     "<mesh file='somewhere/else/a.obj'/></asset></mujoco>"));
  EXPECT_EQ(root.children[1].children[0].Get("file"), mesh);
}

TEST_F(MjcfDocumentTest, WritesWhatItReadsOneElementALine) {
  const std::string xml =
      "<mujoco>\n<a x=\"1 &lt; &quot;2&quot; &amp; 3\">\n<b/>\n</a>\n</mujoco>\n";
  const MjcfText text = WriteMjcf(ReadMjcf(Write("a.xml", xml)));
  EXPECT_EQ(text.xml, xml);
  ASSERT_EQ(text.lines.size(), 5u);
  EXPECT_EQ(text.lines[2].line, 3);
}

TEST_F(MjcfDocumentTest, KeepsALineWhereAValueHasSeveral) {
  const MjcfText text = WriteMjcf(ReadMjcf(Write("a.xml", "<mujoco><a x='1\n2&#10;3'/></mujoco>")));
  EXPECT_EQ(text.xml, "<mujoco>\n<a x=\"1 2 3\"/>\n</mujoco>\n");
}

TEST_F(MjcfDocumentTest, RefusesAMissingFile) {
  EXPECT_THAT(Refusal(folder_.path() / "a.xml"), EndsWith("a.xml: no such file"));
}

TEST_F(MjcfDocumentTest, RefusesAFolder) {
  EXPECT_THAT(Refusal(folder_.path()), EndsWith(": is a folder"));
}

TEST_F(MjcfDocumentTest, RefusesAnEmptyFile) {
  EXPECT_THAT(Refusal(Write("a.xml", "")), HasSubstr("a.xml: is not XML: it is empty"));
}

TEST_F(MjcfDocumentTest, RefusesAFileThatIsNoXml) {
  EXPECT_THAT(Refusal(Write("a.xml",
                            "\x7f"
                            "ELF\x01\x02\x03")),
              HasSubstr("is not XML: "));
}

TEST_F(MjcfDocumentTest, RefusesAnotherRoot) {
  EXPECT_THAT(Refusal(Write("a.xml", "\n<robot name='x'/>")),
              AllOf(HasSubstr("a.xml:2: "), HasSubstr("<robot>")));
}

TEST_F(MjcfDocumentTest, RefusesAMissingInclude) {
  EXPECT_THAT(Refusal(Write("a.xml", "<mujoco>\n<include file='b.xml'/></mujoco>")),
              AllOf(HasSubstr("a.xml:2: "), EndsWith("b.xml: no such file")));
}

TEST_F(MjcfDocumentTest, RefusesAnIncludeWithoutAFile) {
  EXPECT_THAT(Refusal(Write("a.xml", "<mujoco>\n<include/></mujoco>")),
              EndsWith("a.xml:2: <include> names no file"));
}

TEST_F(MjcfDocumentTest, RefusesAFileThatIncludesItself) {
  EXPECT_THAT(Refusal(Write("a.xml", "<mujoco>\n<include file='a.xml'/></mujoco>")),
              AllOf(HasSubstr("a.xml:2: "), HasSubstr("is included a second time")));
}

TEST_F(MjcfDocumentTest, RefusesACycleOfIncludes) {
  Write("b.xml", "<mujoco><include file='./a.xml'/></mujoco>");
  EXPECT_THAT(Refusal(Write("a.xml", "<mujoco><include file='b.xml'/></mujoco>")),
              AllOf(HasSubstr("b.xml:1: "), HasSubstr("is included a second time")));
}

TEST_F(MjcfDocumentTest, RefusesAMissingMesh) {
  EXPECT_THAT(Refusal(Write("a.xml", "<mujoco><asset>\n<mesh file='a.obj'/></asset></mujoco>")),
              AllOf(HasSubstr("a.xml:2: <mesh> file: no file "), EndsWith("a.obj")));
}

TEST_F(MjcfDocumentTest, RefusesTooManyLevels) {
  EXPECT_THAT(Refusal(Write("a.xml", "<mujoco>" + Repeated("<body>", 100'000))),
              HasSubstr("nested too deep"));
}

TEST_F(MjcfDocumentTest, RefusesLevelsThatIncludesPileUp) {
  const std::string deep = Repeated("<body>", 60);
  const std::string end = Repeated("</body>", 60);
  Write("b.xml", "<mujoco>" + deep + end + "</mujoco>");
  EXPECT_THAT(
      Refusal(Write("a.xml", "<mujoco>" + deep + "<include file='b.xml'/>" + end + "</mujoco>")),
      AllOf(HasSubstr("b.xml:1: "), HasSubstr("deeper than the 99 levels")));
}

TEST_F(MjcfDocumentTest, RefusesAFileOfAHundredMegabytesUnread) {
  const std::filesystem::path file = Write("a.xml", "<mujoco/>");
  std::filesystem::resize_file(file, 100'000'000);
  EXPECT_THAT(Refusal(file), HasSubstr("too large"));
}

TEST_F(MjcfDocumentTest, ExpandsNoEntities) {
  const MjcfElement root = ReadMjcf(Write("a.xml",
                                          "<!DOCTYPE m [<!ENTITY a 'ha'><!ENTITY b '&a;&a;&a;'>]>"
                                          "<mujoco model='&b;'/>"));
  EXPECT_EQ(root.Get("model"), "&b;");
}

}  // namespace
}  // namespace understudy::mjcf
