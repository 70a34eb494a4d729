#include "services/request.h"

#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "services/parameter.h"

namespace understudy::services {
namespace {

// As XCDR1 and XCDR2 have it in this machine's byte order.
std::vector<std::byte> Serialized(const std::string& parameter, std::uint32_t binary) {
  std::vector<std::byte> bytes(4 + 36);
  const auto put = [&](std::size_t at, auto value) {
    std::memcpy(bytes.data() + 4 + at, &value, sizeof value);
  };
  put(0, std::int64_t{41});
  put(8, std::int64_t{1008});
  put(16, std::int64_t{7});
  put(24, std::int32_t{-3});
  put(28, std::uint8_t{1});
  put(32, static_cast<std::uint32_t>(parameter.size() + 1));
  for (const char c : parameter) bytes.push_back(static_cast<std::byte>(c));
  bytes.push_back(std::byte{0});
  while (bytes.size() % 4 != 0) bytes.push_back(std::byte{0});
  bytes.resize(bytes.size() + 4 + binary);
  std::memcpy(bytes.data() + bytes.size() - binary - 4, &binary, sizeof binary);
  return bytes;
}

TEST(ReadRequestTest, ReadsWhatThereIs) {
  const std::vector<std::byte> bytes = Serialized(R"({"x":1})", 3);
  const auto view = ReadRequest(bytes);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->id, 41);
  EXPECT_EQ(view->api_id, 1008);
  EXPECT_EQ(view->lease_id, 7);
  EXPECT_EQ(view->priority, -3);
  EXPECT_TRUE(view->noreply);
  EXPECT_EQ(view->parameter, R"({"x":1})");
  EXPECT_EQ(view->binary_bytes, 3U);
}

TEST(ReadRequestTest, EndsAParameterAtItsFirstZero) {
  const std::vector<std::byte> bytes = Serialized(std::string("ab\0cd", 5), 0);
  EXPECT_EQ(ReadRequest(bytes)->parameter, "ab");
}

TEST(ReadRequestTest, RefusesBytesThatEndTooSoon) {
  const std::vector<std::byte> bytes = Serialized("abc", 0);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(ReadRequest(std::span(bytes).first(size))) << size;
  }
}

TEST(DecodeParameterTest, RefusesMoreValuesThanAnybodySends) {
  const Field numbers{.key = "data", .type = &schema::kNumbers, .required = true};
  const auto list = [](std::size_t values) {
    std::string text = R"({"data":[1)";
    for (std::size_t i = 1; i < values; ++i) text += ",1";
    return text + "]}";
  };
  EXPECT_TRUE(DecodeParameter(list(kMostParameterValues - 2), {&numbers, 1}));
  EXPECT_FALSE(DecodeParameter(list(kMostParameterValues + 1), {&numbers, 1}));
}

TEST(DecodeParameterTest, CountsNoCommasInTexts) {
  const Field text{.key = "data", .type = &kString, .required = true};
  const std::string commas = R"({"data":"\")" + std::string(2000, ',') + "\"}";
  EXPECT_TRUE(DecodeParameter(commas, {&text, 1}));
}

}  // namespace
}  // namespace understudy::services
