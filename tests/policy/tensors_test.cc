#include "policy/tensors.h"

#include <cstdint>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/policy/files.h"

namespace understudy::policy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string WhyNot(const std::string& bytes) {
  try {
    ParseTensors(bytes, "walk.safetensors");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

// A header with one tensor "w" of those fields.
std::string Header(const std::string& fields) { return "{\"w\":{" + fields + "}}"; }

TEST(TensorsTest, ReadsValuesShapesAndMetadata) {
  const TensorFile made{.tensors = {{"0.weight", {.shape = {2, 3}, .values = {1, 2, 3, 4, 5, 6}}},
                                    {"empty", {.shape = {0, 4}, .values = {}}},
                                    {"scalar", {.shape = {}, .values = {7}}}},
                        .metadata = {{"activation", "elu"}}};
  const TensorFile read = ParseTensors(TensorBytes(made), "walk.safetensors");
  EXPECT_EQ(read.metadata, made.metadata);
  ASSERT_EQ(read.tensors.size(), 3U);
  EXPECT_THAT(read.tensors.at("0.weight").shape, ElementsAre(2, 3));
  EXPECT_THAT(read.tensors.at("0.weight").values, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(read.tensors.at("scalar").values, ElementsAre(7));
}

TEST(TensorsTest, RefusesEachHostileFileWithAReason) {
  const std::string good = R"("dtype":"F32","shape":[2],"data_offsets":[0,8])";
  const std::string data(8, '\0');
  ASSERT_EQ(WhyNot(RawBytes(Header(good), data)), "");
  std::string long_header(8, '\xff');
  const std::pair<std::string, const char*> rows[] = {
      {"", "got 0 bytes"},
      {"short", "got 5 bytes"},
      {long_header + "{}", "its header would have 18446744073709551615 bytes"},
      {RawBytes("{}", "").substr(0, 9), "its header would have 2 bytes"},
      {RawBytes("[1]", ""), "no JSON object"},
      {RawBytes("{\"w\":", ""), "no JSON object"},
      {RawBytes(std::string(100000, '['), ""), "no JSON object"},
      {RawBytes("{\"w\":3}", data), "w: expected dtype, shape and data_offsets"},
      {RawBytes(Header(R"("dtype":"BF16","shape":[2],"data_offsets":[0,8])"), data),
       "w: dtype: expected F32, got BF16"},
      {RawBytes(Header(R"("dtype":4,"shape":[2],"data_offsets":[0,8])"), data), "expected F32"},
      {RawBytes(Header(R"("dtype":"F32","shape":[-2],"data_offsets":[0,8])"), data), "w: shape"},
      {RawBytes(Header(R"("dtype":"F32","shape":[2.5],"data_offsets":[0,8])"), data), "w: shape"},
      {RawBytes(Header(R"("dtype":"F32","shape":[1,1,1,1,1,1,1,1,2],"data_offsets":[0,8])"), data),
       "w: shape"},
      {RawBytes(Header(R"("dtype":"F32","shape":[3],"data_offsets":[0,8])"), data),
       "w: shape: does not fit its 8 bytes"},
      {RawBytes(Header(R"("dtype":"F32","shape":[4611686018427387904,4],"data_offsets":[0,0])"),
                data),
       "w: shape: does not fit its 0 bytes"},
      {RawBytes(Header(R"("dtype":"F32","shape":[2],"data_offsets":[0])"), data), "data_offsets"},
      {RawBytes(Header(R"("dtype":"F32","shape":[2],"data_offsets":[8,0])"), data), "data_offsets"},
      {RawBytes(Header(R"("dtype":"F32","shape":[4],"data_offsets":[0,16])"), data),
       "within the 8 bytes of data"},
      {RawBytes("{\"a\":{" + good + "},\"b\":{" + good + "}}", data), "tensors overlap"},
      {RawBytes("{\"\\n\":{" + good + "}}", data), ".: expected a name"},
      {RawBytes("{\"__metadata__\":[]}", ""), "__metadata__: expected an object of texts"},
      {RawBytes("{\"__metadata__\":{\"a\":1}}", ""), "a: expected a text"},
  };
  for (const auto& [bytes, why] : rows) {
    EXPECT_THAT(WhyNot(bytes), HasSubstr(why));
    EXPECT_THAT(WhyNot(bytes), ::testing::StartsWith("walk.safetensors: "));
  }
}

TEST(TensorsTest, SaysThatAFileIsMissing) {
  try {
    ReadTensors("/nowhere/walk.safetensors");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "/nowhere/walk.safetensors: expected a file of weights: no such file, or it is "
                 "empty");
  }
}

}  // namespace
}  // namespace understudy::policy
