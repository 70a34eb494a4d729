// That docs/openapi.yaml documents what there is, and nothing else.
#include <algorithm>
#include <set>
#include <string>

#include <yaml-cpp/yaml.h>

#include "control/frame_json.h"
#include "control/routes.h"
#include "gtest/gtest.h"

namespace understudy {
namespace {

const YAML::Node& Document() {
  static const YAML::Node kDocument =
      YAML::LoadFile(std::string{UNDERSTUDY_SOURCE_DIR} + "/docs/openapi.yaml");
  return kDocument;
}

TEST(OpenApiTest, HasEveryRouteAndNoOther) {
  std::set<std::string> served;
  for (const RouteName& route : AllRoutes()) {
    std::string method{route.method};
    std::ranges::transform(method, method.begin(),
                           [](char c) { return static_cast<char>(c - 'A' + 'a'); });
    served.insert(method + " " + std::string{route.path});
  }
  std::set<std::string> documented;
  for (const auto& path : Document()["paths"]) {
    for (const auto& method : path.second) {
      documented.insert(method.first.as<std::string>() + " " + path.first.as<std::string>());
    }
  }
  EXPECT_EQ(documented, served);
}

TEST(OpenApiTest, HasEveryPartOfAFrameAndNoOther) {
  std::set<std::string> documented;
  for (const auto& key : Document()["components"]["schemas"]["Frame"]["properties"]) {
    documented.insert(key.first.as<std::string>());
  }
  std::set<std::string> sent{"step", "time", "speed", "paused"};
  for (const FramePartName& part : kFrameParts) sent.emplace(part.name);
  EXPECT_EQ(documented, sent);
}

TEST(OpenApiTest, WhatWritesAsksForTheToken) {
  for (const auto& path : Document()["paths"]) {
    const YAML::Node post = path.second["post"];
    if (post) {
      EXPECT_TRUE(post["security"][0]["token"]) << path.first.as<std::string>();
    }
  }
}

}  // namespace
}  // namespace understudy
