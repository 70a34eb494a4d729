#include "server/snapshot_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "gtest/gtest.h"

namespace understudy::server {
namespace {

using nlohmann::json;

emulator::Snapshot SomeSnapshot() {
  emulator::Snapshot snapshot;
  snapshot.parts = emulator::kAllSnapshotParts;
  snapshot.body_names = {"world", "base \"link\""};
  snapshot.step = 7;
  snapshot.time = 0.007;
  snapshot.speed = 0.5;
  snapshot.paused = true;
  snapshot.positions = {0.1, 1.0 / 3};
  snapshot.bodies = {{0, 0, 0, 1, 0, 0, 0}, {1, 2, 3, 0, 1, 0, 0}};
  snapshot.contacts = {{.at = {1, 2, 3}, .force = {0, 0, 40}, .geoms = {0, 5}}};
  snapshot.com = {0.5, 0, 0.25};
  snapshot.crane = {.attached = true, .hook = {0, 0, 1}, .top = {0, 0, 2}, .tension = 300};
  snapshot.pushes = {{.body = 1, .at = {1, 1, 1}, .force = {0, 60, 0}}};
  snapshot.motors = {{.enabled = true, .q = 1, .dq = 2, .tau = 3, .casing_c = 40, .winding_c = 50}};
  snapshot.imus[0].f_WI_I = {0, 0, 9.5};
  snapshot.battery = {.voltage = 30, .current = -2, .soc = 0.75, .temperature_c = 25};
  snapshot.feet = {10, 20};
  snapshot.touch = {0, 0.5F};
  snapshot.remote = {.there = true, .keys = 0x0020 | 0x0200, .lx = -1};
  snapshot.wireless_remote[0] = 0x55;
  snapshot.truth.q = {0.5};
  snapshot.truth.dq = {0.25};
  snapshot.truth.tau = {2};
  snapshot.truth.imu.w_WI_I = {1, 2, 3};
  snapshot.truth.foot_force = {40};
  snapshot.motion = {.service = {'m', 'c', 'f'}, .state = 1004, .name = "lying"};
  snapshot.command = {{.enabled = true, .q = 1, .dq = 0, .tau = 0.5, .kp = 20, .kd = 1}};
  return snapshot;
}

TEST(SnapshotJsonTest, HasEachFigureOfDamageWithItsLimitAndSource) {
  emulator::Snapshot shown = SomeSnapshot();
  shown.motor_names = {"knee", "wheel"};
  shown.damage.motors = {{.largest_jump = 0.75}, {}};
  shown.limits = {{.torque = 24, .speed = 30, .jump = 0.5}, {}};
  shown.damage_limits = {{"shock", 39, "m/s²", "derived: its range"},
                         {"at_torque_limit", std::nan(""), "N·m", "vendor: \"URDF\""},
                         {"largest_jump", std::nan(""), "rad", "derived: so"}};
  const json damage = json::parse(SnapshotJson(shown, emulator::kPartDamage))["damage"];
  EXPECT_EQ(damage["motors"][0]["joint"], "knee");
  EXPECT_EQ(damage["motors"][0]["torque_limit"], 24.0);
  EXPECT_EQ(damage["motors"][0]["speed_limit"], 30.0);
  EXPECT_EQ(damage["motors"][0]["largest_jump"], 0.75);
  EXPECT_EQ(damage["motors"][0]["jump_limit"], 0.5);
  EXPECT_EQ(damage["motors"][1]["jump_limit"], 0.0);
  EXPECT_EQ(damage["limits"][0], json({{"figure", "shock"},
                                       {"limit", 39.0},
                                       {"unit", "m/s²"},
                                       {"source", "derived: its range"},
                                       {"reached", 0.0},
                                       {"reached_unit", "m/s²"},
                                       {"held_against", 39.0},
                                       {"motor", ""},
                                       {"mark", "ok"}}));
  EXPECT_EQ(damage["limits"][1]["limit"], nullptr);
  EXPECT_EQ(damage["limits"][1]["source"], "vendor: \"URDF\"");
  EXPECT_EQ(damage["limits"][2]["motor"], "knee");
  EXPECT_EQ(damage["limits"][2]["reached"], 0.75);
  EXPECT_EQ(damage["limits"][2]["held_against"], 0.5);
  EXPECT_EQ(damage["limits"][2]["mark"], "beyond");
  EXPECT_EQ(damage["motors"][0]["mark"], "beyond");
  EXPECT_EQ(damage["motors"][1]["mark"], "ok");
}

TEST(SnapshotJsonTest, OffersOfEachComponentTheFaultsThatItCanHave) {
  static constexpr robot::FaultKind kLimp{
      .of = robot::Component::kMotor, .name = "limp", .does = "Nothing"};
  static constexpr robot::FaultKind kHot{.of = robot::Component::kMotor,
                                         .name = "hot",
                                         .does = "Warm",
                                         .unit = "°C",
                                         .low = 0,
                                         .high = 200,
                                         .otherwise = 60};
  emulator::Snapshot shown;
  shown.components = {"knee", "rt/none", "hip"};
  shown.component_faults = {{&kLimp, &kHot}, {}, {&kHot}};
  EXPECT_EQ(FaultsJson(shown), nlohmann::ordered_json::parse(R"({
      "components": [{"name": "knee", "of": "motor", "faults": ["limp", "hot"]},
                     {"name": "hip", "of": "motor", "faults": ["hot"]}],
      "kinds": [{"of": "motor", "fault": "limp", "does": "Nothing", "unit": "", "range": null,
                 "default": null},
                {"of": "motor", "fault": "hot", "does": "Warm", "unit": "°C",
                 "range": [0.0, 200.0], "default": 60.0}]})"));
}

TEST(SnapshotJsonTest, HasEveryPart) {
  const json snapshot = json::parse(SnapshotJson(SomeSnapshot(), emulator::kAllSnapshotParts));
  EXPECT_EQ(snapshot["step"], 7);
  EXPECT_EQ(snapshot["time"], 0.007);
  EXPECT_EQ(snapshot["speed"], 0.5);
  EXPECT_EQ(snapshot["paused"], true);
  EXPECT_EQ(snapshot["qpos"], json({0.1, 1.0 / 3}));
  EXPECT_EQ(snapshot["bodies"][1], json({1.0, 2.0, 3.0, 0.0, 1.0, 0.0, 0.0}));
  EXPECT_EQ(snapshot["contacts"][0]["force"], json({0.0, 0.0, 40.0}));
  EXPECT_EQ(snapshot["contacts"][0]["geoms"], json({0, 5}));
  EXPECT_EQ(snapshot["com"], json({0.5, 0.0, 0.25}));
  EXPECT_EQ(snapshot["crane"]["tension"], 300.0);
  EXPECT_EQ(snapshot["pushes"][0]["body"], "base \"link\"");
  EXPECT_EQ(snapshot["motors"][0]["winding"], 50.0);
  EXPECT_EQ(snapshot["motors"][0]["enabled"], true);
  EXPECT_EQ(snapshot["imus"].size(), 1u);
  EXPECT_EQ(snapshot["imus"][0]["accelerometer"], json({0.0, 0.0, 9.5}));
  EXPECT_EQ(snapshot["battery"]["soc"], 0.75);
  EXPECT_EQ(snapshot["feet"], json({10.0, 20.0}));
  EXPECT_EQ(snapshot["remote"]["keys"], "L2+B");
  EXPECT_EQ(snapshot["wireless_remote"].size(), 40u);
  EXPECT_EQ(snapshot["wireless_remote"][0], 0x55);
  EXPECT_EQ(snapshot["command"][0]["kp"], 20.0);
  EXPECT_EQ(snapshot["truth"]["q"], json({0.5}));
  EXPECT_EQ(snapshot["truth"]["dq"], json({0.25}));
  EXPECT_EQ(snapshot["truth"]["tau"], json({2.0}));
  EXPECT_EQ(snapshot["truth"]["feet"], json({40.0}));
  EXPECT_EQ(snapshot["truth"]["imus"].size(), snapshot["imus"].size());
  EXPECT_EQ(snapshot["truth"]["imus"][0]["gyroscope"], json({1.0, 2.0, 3.0}));
  EXPECT_FALSE(snapshot["truth"]["imus"][0].contains("temperature"));
  EXPECT_EQ(snapshot["touch"], json({0.0, 0.5}));
  EXPECT_EQ(snapshot["motion"], json({{"service", "mcf"}, {"state", 1004}, {"name", "lying"}}));
  EXPECT_EQ(snapshot.size(), 4 + std::size(emulator::kSnapshotParts));
}

TEST(SnapshotJsonTest, HasOnlyWhatIsAskedForAndThere) {
  emulator::Snapshot snapshot = SomeSnapshot();
  EXPECT_EQ(json::parse(SnapshotJson(snapshot, emulator::kPartCom)).size(), 5u);
  snapshot.parts = emulator::kPartCom;
  EXPECT_EQ(json::parse(SnapshotJson(snapshot, emulator::kAllSnapshotParts)).size(), 5u);
}

TEST(SnapshotJsonTest, SaysWhatAFrictionOfZeroStandsFor) {
  emulator::Snapshot snapshot;
  schema::Entry friction;
  friction.key = "terrain.friction";
  snapshot.setting_keys = {friction};
  const auto stands_for = [&](double setting, double least, double most) {
    snapshot.settings = {setting};
    snapshot.ground_friction = {least, most};
    return json(SettingsJson(snapshot)["settings"][0]).value("stands_for", "nothing");
  };
  EXPECT_EQ(stands_for(0, 0.8, 0.8), "0.8");
  EXPECT_EQ(stands_for(0, 0.25, 0.8), "0.25 to 0.8");
  EXPECT_EQ(stands_for(0.5, 0.5, 0.5), "nothing");
}

TEST(SnapshotJsonTest, WhatIsNoNumberIsNull) {
  emulator::Snapshot snapshot = SomeSnapshot();
  snapshot.positions = {std::nan(""), INFINITY, 1e300};
  snapshot.com = {std::nan(""), 1e300, 0};
  const json text = json::parse(SnapshotJson(snapshot, emulator::kAllSnapshotParts));
  EXPECT_EQ(text["qpos"], json({nullptr, nullptr, 1e300}));
  EXPECT_EQ(text["com"], json({nullptr, nullptr, 0.0}));
}

TEST(SnapshotJsonTest, SurvivesANameThatIsNoText) {
  emulator::Snapshot snapshot = SomeSnapshot();
  snapshot.body_names[1] = "\xff";
  EXPECT_FALSE(
      json::parse(SnapshotJson(snapshot, emulator::kPartPushes), nullptr, false).is_discarded());
}

TEST(SnapshotJsonTest, ReadsTheNamesOfParts) {
  std::string unknown;
  EXPECT_EQ(ReadSnapshotParts("qpos,com", &unknown), emulator::kPartPositions | emulator::kPartCom);
  EXPECT_EQ(ReadSnapshotParts("", &unknown), 0u);
  EXPECT_EQ(ReadSnapshotParts("qpos,", &unknown), emulator::kPartPositions);
  EXPECT_EQ(ReadSnapshotParts("qpos,,com", &unknown), std::nullopt);
  EXPECT_EQ(ReadSnapshotParts("com,refusals", &unknown), std::nullopt);
  EXPECT_EQ(unknown, "refusals");
}

}  // namespace
}  // namespace understudy::server
