#include "server/frame_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "gtest/gtest.h"

namespace understudy::server {
namespace {

using nlohmann::json;

emulator::Frame SomeFrame() {
  emulator::Frame frame;
  frame.parts = emulator::kAllFrameParts;
  frame.body_names = {"world", "base \"link\""};
  frame.step = 7;
  frame.time = 0.007;
  frame.speed = 0.5;
  frame.paused = true;
  frame.positions = {0.1, 1.0 / 3};
  frame.bodies = {{0, 0, 0, 1, 0, 0, 0}, {1, 2, 3, 0, 1, 0, 0}};
  frame.contacts = {{.at = {1, 2, 3}, .force = {0, 0, 40}, .geoms = {0, 5}}};
  frame.com = {0.5, 0, 0.25};
  frame.crane = {.attached = true, .hook = {0, 0, 1}, .top = {0, 0, 2}, .tension = 300};
  frame.pushes = {{.body = 1, .at = {1, 1, 1}, .force = {0, 60, 0}}};
  frame.motors = {{.enabled = true, .q = 1, .dq = 2, .tau = 3, .casing_c = 40, .winding_c = 50}};
  frame.imus[0].f_WI_I = {0, 0, 9.5};
  frame.battery = {.voltage = 30, .current = -2, .soc = 0.75, .temperature_c = 25};
  frame.feet = {10, 20};
  frame.remote = {.there = true, .keys = 0x0020 | 0x0200, .lx = -1};
  frame.wireless_remote[0] = 0x55;
  frame.command = {{.enabled = true, .q = 1, .dq = 0, .tau = 0.5, .kp = 20, .kd = 1}};
  return frame;
}

TEST(FrameJsonTest, HasEveryPart) {
  const json frame = json::parse(FrameJson(SomeFrame(), emulator::kAllFrameParts));
  EXPECT_EQ(frame["step"], 7);
  EXPECT_EQ(frame["time"], 0.007);
  EXPECT_EQ(frame["speed"], 0.5);
  EXPECT_EQ(frame["paused"], true);
  EXPECT_EQ(frame["qpos"], json({0.1, 1.0 / 3}));
  EXPECT_EQ(frame["bodies"][1], json({1.0, 2.0, 3.0, 0.0, 1.0, 0.0, 0.0}));
  EXPECT_EQ(frame["contacts"][0]["force"], json({0.0, 0.0, 40.0}));
  EXPECT_EQ(frame["contacts"][0]["geoms"], json({0, 5}));
  EXPECT_EQ(frame["com"], json({0.5, 0.0, 0.25}));
  EXPECT_EQ(frame["crane"]["tension"], 300.0);
  EXPECT_EQ(frame["pushes"][0]["body"], "base \"link\"");
  EXPECT_EQ(frame["motors"][0]["winding"], 50.0);
  EXPECT_EQ(frame["motors"][0]["enabled"], true);
  EXPECT_EQ(frame["imus"].size(), 1u);
  EXPECT_EQ(frame["imus"][0]["accelerometer"], json({0.0, 0.0, 9.5}));
  EXPECT_EQ(frame["battery"]["soc"], 0.75);
  EXPECT_EQ(frame["feet"], json({10.0, 20.0}));
  EXPECT_EQ(frame["remote"]["keys"], "L2+B");
  EXPECT_EQ(frame["wireless_remote"].size(), 40u);
  EXPECT_EQ(frame["wireless_remote"][0], 0x55);
  EXPECT_EQ(frame["command"][0]["kp"], 20.0);
  EXPECT_EQ(frame.size(), 4 + std::size(emulator::kFrameParts));
}

TEST(FrameJsonTest, HasOnlyWhatIsAskedForAndThere) {
  emulator::Frame frame = SomeFrame();
  EXPECT_EQ(json::parse(FrameJson(frame, emulator::kPartCom)).size(), 5u);
  frame.parts = emulator::kPartCom;
  EXPECT_EQ(json::parse(FrameJson(frame, emulator::kAllFrameParts)).size(), 5u);
}

TEST(FrameJsonTest, WhatIsNoNumberIsNull) {
  emulator::Frame frame = SomeFrame();
  frame.positions = {std::nan(""), INFINITY, 1e300};
  frame.com = {std::nan(""), 1e300, 0};
  const json text = json::parse(FrameJson(frame, emulator::kAllFrameParts));
  EXPECT_EQ(text["qpos"], json({nullptr, nullptr, 1e300}));
  EXPECT_EQ(text["com"], json({nullptr, nullptr, 0.0}));
}

TEST(FrameJsonTest, SurvivesANameThatIsNoText) {
  emulator::Frame frame = SomeFrame();
  frame.body_names[1] = "\xff";
  EXPECT_FALSE(json::parse(FrameJson(frame, emulator::kPartPushes), nullptr, false).is_discarded());
}

TEST(FrameJsonTest, ReadsTheNamesOfParts) {
  std::string unknown;
  EXPECT_EQ(ReadFrameParts("qpos,com", &unknown), emulator::kPartPositions | emulator::kPartCom);
  EXPECT_EQ(ReadFrameParts("", &unknown), 0u);
  EXPECT_EQ(ReadFrameParts("qpos,", &unknown), emulator::kPartPositions);
  EXPECT_EQ(ReadFrameParts("qpos,,com", &unknown), std::nullopt);
  EXPECT_EQ(ReadFrameParts("com,refusals", &unknown), std::nullopt);
  EXPECT_EQ(unknown, "refusals");
}

}  // namespace
}  // namespace understudy::server
