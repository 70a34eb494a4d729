#include "schema/yaml_document.h"

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace understudy::schema {
namespace {

using test::ErrorOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string ParseError(const std::string& text) {
  return ErrorOf([&] { ParseYaml(text, "a.yaml"); });
}

TEST(YamlDocumentTest, KnowsTheLineOfEachValue) {
  const YamlValue root = ParseYaml("a: 1\nb:\n  - x\n  - 'y'\n", "a.yaml");
  EXPECT_EQ(root.Find("a")->where, "a.yaml:1");
  EXPECT_EQ(root.Find("b")->items[1].where, "a.yaml:4");
  EXPECT_TRUE(root.Find("b")->items[1].quoted);
  EXPECT_EQ(root.Find("c"), nullptr);
}

TEST(YamlDocumentTest, TakesAnEmptyTextAsNothing) {
  for (const char* text : {"", "\n", "# only words\n", "---\n"}) {
    EXPECT_EQ(ParseYaml(text, "a.yaml").kind, YamlValue::Kind::kNull) << text;
  }
}

TEST(YamlDocumentTest, MergesAMappingUnderItsOwnKeys) {
  const YamlValue root = ParseYaml("- &m {a: 1, b: 2}\n- {b: 3, <<: *m}\n", "a.yaml");
  ASSERT_EQ(root.items[1].keys.size(), 2U);
  EXPECT_EQ(root.items[1].Find("a")->text, "1");
  EXPECT_EQ(root.items[1].Find("b")->text, "3");
}

TEST(YamlDocumentTest, RefusesWhatMeansTwoThingsOrNone) {
  const std::pair<const char*, const char*> rows[] = {
      {"a: 1\nb: 2\na: 3\n", "a.yaml:3: key 'a' is given twice, first at a.yaml:1"},
      {"a: &a\n  - *a\n", "a.yaml:2: an alias stands inside the value it names"},
      {"a: &a [1]\nb: {<<: *a}\n", "a.yaml:1: '<<' expects one mapping, got a list"},
      {"a: 1\n? [x]\n: 2\n", "a.yaml:2: expected a word as key, got a list"},
  };
  for (const auto& [text, error] : rows) EXPECT_EQ(ParseError(text), error);
}

TEST(YamlDocumentTest, RefusesAnAliasBomb) {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last;
    for (int k = 0; k < 9; ++k) text += ", " + last;
    text += "]\n";
  }
  EXPECT_EQ(ParseError(text), "a.yaml:5: more than 20000 values, aliases resolved");
}

TEST(YamlDocumentTest, RefusesAnUnknownAlias) {
  EXPECT_THAT(ParseError("a: 1\nb: *none\n"), StartsWith("a.yaml:2: not valid YAML"));
}

TEST(YamlDocumentTest, RefusesDeepNesting) {
  EXPECT_EQ(ParseError(std::string(100000, '[')), "a.yaml:1: nested more than 32 levels deep");
  EXPECT_EQ(ParseError(std::string(100000, '{')), "a.yaml:1: nested more than 32 levels deep");
}

TEST(YamlDocumentTest, RefusesATag) {
  EXPECT_THAT(ParseError("a: 1\nb: !!python/object x\n"), StartsWith("a.yaml:2: tag '"));
}

TEST(YamlDocumentTest, RefusesAQuoteThatSwallowsTheRest) {
  EXPECT_THAT(ParseError("a: 'open\nb: 2\nc: 3\n"), HasSubstr("not valid YAML: illegal EOF"));
  EXPECT_THAT(ParseError("a: \"open\nb: 2\n\n"), HasSubstr("not valid YAML: illegal EOF"));
}

TEST(YamlDocumentTest, RefusesADirective) {
  EXPECT_EQ(ParseError("a: 1\n%b: 2\nc: 3\n"),
            "a.yaml:2: a line that begins with '%' is not understood");
  EXPECT_NE(ParseError("%YAML 1.2\n---\na: 1\n"), "");
}

TEST(YamlDocumentTest, RefusesASecondDocument) {
  EXPECT_EQ(ParseError("a: 1\n---\nb: 2\n"),
            "a.yaml:3: a second document begins; one file holds one");
  EXPECT_NE(ParseError("a: 1\n...\nb: 2\n"), "");
}

TEST(YamlDocumentTest, RefusesTabsAsIndentation) {
  EXPECT_THAT(ParseError("a:\n\tb: 1\n"), StartsWith("a.yaml:2: not valid YAML"));
}

TEST(YamlDocumentTest, NamesTheLineOfWhatIsNoYaml) {
  for (const char* line :
       {"b: [1, 2", "b: 'open", "b: }", "]", "b: \"\\q\"", "b: : :", "b: \"open", "@x"}) {
    EXPECT_THAT(ParseError(std::string("a: 1\n") + line + "\n"), StartsWith("a.yaml:")) << line;
  }
}

TEST(YamlDocumentTest, SurvivesBytesThatAreNoText) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  for (const std::string& text : {bytes, std::string(1000, '\0'), std::string("\xff\xfe\x00x", 4),
                                  "a: " + bytes, "a: \"" + bytes + "\""}) {
    ParseError(text);  // whatever it is taken for, it must end with a value or a ConfigError
  }
}

class YamlFileTest : public testing::Test {
 protected:
  // An error without the folder in which its file is.
  std::string Relative(const std::string& error) const {
    EXPECT_TRUE(error.starts_with(directory_.string() + "/")) << error;
    return error.substr(directory_.string().size() + 1);
  }

  test::TemporaryFolder folder_;
  const std::filesystem::path directory_ = folder_.path();
};

TEST_F(YamlFileTest, RefusesAMissingFile) {
  const std::string error = ErrorOf([&] { ReadYamlFile(directory_ / "none.yaml"); });
  EXPECT_EQ(Relative(error), "none.yaml: cannot be read: No such file or directory");
}

TEST_F(YamlFileTest, RefusesANameTooLongForAFile) {
  const std::string error = ErrorOf([] { ReadYamlFile(std::string(300, 'a')); });
  EXPECT_EQ(error, std::string(300, 'a') + ": cannot be read: File name too long");
}

TEST_F(YamlFileTest, RefusesADirectory) {
  EXPECT_EQ(Relative(ErrorOf([&] { ReadYamlFile(folder_.Write("config/a", "").parent_path()); })),
            "config: is a directory");
}

TEST_F(YamlFileTest, ReadsAPipeAndDoesNotWaitForOneIntoWhichNobodyWrites) {
  const std::string pipe = directory_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(Relative(ErrorOf([&] { ReadYamlFile(pipe); })),
            "pipe: is a pipe into which nobody writes");
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const std::jthread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(::write(ends[1], "a: 1\n", 5), 5);
    ::close(ends[1]);
  });
  EXPECT_EQ(ReadYamlFile("/proc/self/fd/" + std::to_string(ends[0])).items.size(), 1U);
  ::close(ends[0]);
}

TEST_F(YamlFileTest, RefusesAHugeFile) {
  const std::string path = folder_.Write("huge.yaml", std::string((1 << 20) + 1, '#'));
  EXPECT_EQ(Relative(ErrorOf([&] { ReadYamlFile(path); })),
            "huge.yaml: larger than 1 MiB, no configuration");
}

TEST_F(YamlFileTest, TakesAFileOfJustOneMebibyte) {
  EXPECT_EQ(ReadYamlFile(folder_.Write("full.yaml", std::string(1 << 20, '#'))).kind,
            YamlValue::Kind::kNull);
}

}  // namespace
}  // namespace understudy::schema
