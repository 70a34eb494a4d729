// Checks that openapi.yaml documents exactly the existing routes.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <yaml-cpp/yaml.h>

#include "gtest/gtest.h"
#include "server/request_docs.h"
#include "server/routes.h"
#include "server/snapshot_json.h"
#include "server/status_json.h"

namespace understudy::server {
namespace {

const YAML::Node& Document() {
  static const YAML::Node kDocument = [] {
    std::ifstream file(std::string{UNDERSTUDY_SOURCE_DIR} + "/src/server/openapi.yaml");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    return YAML::Load(text + RequestsOpenApi());  // as src/CMakeLists.txt joins them
  }();
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

TEST(OpenApiTest, HasEveryPartOfASnapshotAndNoOther) {
  std::set<std::string> documented;
  for (const auto& key : Document()["components"]["schemas"]["Snapshot"]["properties"]) {
    documented.insert(key.first.as<std::string>());
  }
  std::set<std::string> sent{"step", "time", "speed", "paused"};
  for (const emulator::SnapshotPartName& part : emulator::kSnapshotParts) sent.emplace(part.name);
  EXPECT_EQ(documented, sent);
}

TEST(OpenApiTest, HasEachFieldOfEachRequest) {
  for (const emulator::RequestRow& row : emulator::RequestRows()) {
    const YAML::Node post = Document()["paths"][RequestPath(row)]["post"];
    ASSERT_TRUE(post) << row.name;
    const YAML::Node schema = post["requestBody"]["content"]["application/json"]["schema"];
    for (const emulator::Field& field : row.fields) {
      EXPECT_TRUE(schema["properties"][std::string(field.key)]) << row.name << ' ' << field.key;
    }
  }
}

// The keys of `sent`, and of the objects in it whose keys are documented.
void ExpectDocumented(const YAML::Node& schema, const nlohmann::ordered_json& sent,
                      const std::string& where) {
  const YAML::Node properties = schema["properties"];
  if (!sent.is_object() || !properties) return;
  std::set<std::string> documented;
  for (const auto& key : properties) documented.insert(key.first.as<std::string>());
  std::set<std::string> keys;
  for (const auto& [key, value] : sent.items()) {
    keys.insert(key);
    ExpectDocumented(properties[key], value, where + "/" + key);
  }
  EXPECT_EQ(documented, keys) << where;
}

TEST(OpenApiTest, HasEveryFieldOfAStatusAndNoOther) {
  ExpectDocumented(Document()["components"]["schemas"]["Status"],
                   StatusJson({.robot = "g1", .version = "", .pid = 1}, {}), "Status");
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
}  // namespace understudy::server
