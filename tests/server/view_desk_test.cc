#include <chrono>
#include <future>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "client/client.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "server/server.h"
#include "tests/support/control.h"
#include "tests/support/eventually.h"

namespace understudy::server {
namespace {

using services::Picture;
using ::testing::HasSubstr;

// Two cameras, whose pictures the test shows.
class FakeViews final : public CameraViews {
 public:
  FakeViews() : cameras_(2) {
    cameras_[0].name = "front";
    cameras_[0].service = "videohub";
    cameras_[0].video_port = 1720;
    cameras_[1].name = "head";
    cameras_[1].width = 640;
    cameras_[1].depth = {0.3, 10};
  }
  std::span<const robot::CameraSpec> cameras() const noexcept override { return cameras_; }
  std::future<Picture> Look(std::size_t camera, bool depth) override {
    const std::lock_guard lock(mutex_);
    asked_.push_back({camera, depth, {}});
    return asked_.back().picture.get_future();
  }
  VideoCounts video(std::size_t camera) const noexcept override {
    return {.sent = 10 + camera, .missed = 3, .unsent = 2};
  }
  const Bell& news() const noexcept override { return news_; }

  // Waits for that many looks, and shows each the name of its camera; its depth is "far".
  void Show(std::size_t looks, Picture::Outcome outcome = Picture::Outcome::kDrawn) {
    EXPECT_TRUE(test::Eventually([&] {
      const std::lock_guard lock(mutex_);
      return asked_.size() >= looks;
    }));
    const std::lock_guard lock(mutex_);
    const auto bytes = [](const std::string& text) {
      return std::make_shared<const std::vector<std::uint8_t>>(text.begin(), text.end());
    };
    for (Asked& asked : asked_) {
      asked.picture.set_value({.outcome = outcome,
                               .jpeg = bytes(cameras_[asked.camera].name),
                               .depth = asked.depth ? bytes("far") : nullptr});
    }
    asked_.clear();
    news_.Ring();
  }

 private:
  struct Asked {
    std::size_t camera = 0;
    bool depth = false;
    std::promise<Picture> picture;
  };

  std::vector<robot::CameraSpec> cameras_;
  Bell news_;
  std::mutex mutex_;
  std::vector<Asked> asked_;
};

class ViewDeskTest : public ::testing::Test {
 protected:
  void Start(const ServerLimits& limits = {}) {
    dut_.emplace(path_, Plane{.identity = {.robot = "g1"}, .board = &board_, .views = &views_},
                 limits);
  }
  std::future<client::ControlReply> Look(const std::string& camera) {
    return std::async(std::launch::async, [this, camera] {
      return client::Call(path_, "GET", "/cameras/" + camera, "", test::kBound);
    });
  }

  test::TemporaryFolder temp_;
  const std::filesystem::path path_ = temp_.path() / "g1.sock";
  emulator::StatusBoard board_;
  FakeViews views_;
  std::optional<ControlServer> dut_;
};

TEST_F(ViewDeskTest, EachWhoLooksGetsThePictureOfItsCamera) {
  Start();
  auto front = Look("front"), head = Look("head"), again = Look("front");
  views_.Show(3);
  EXPECT_EQ(front.get().body, "front");
  EXPECT_EQ(head.get().body, "head");
  EXPECT_EQ(again.get().status, 200u);
}

TEST_F(ViewDeskTest, WhoLooksForDepthGetsThatOfACameraThatMeasuresIt) {
  Start();
  auto depth = Look("head/depth"), picture = Look("head");
  views_.Show(2);
  EXPECT_EQ(depth.get().body, "far");
  EXPECT_EQ(picture.get().body, "head");
  const client::ControlReply none = Look("front/depth").get();
  EXPECT_EQ(none.status, 404u);
  EXPECT_THAT(none.body, HasSubstr("the camera front measures no depth"));
  EXPECT_THAT(Look("haed/depth").get().body, HasSubstr("did you mean 'head'?"));
}

TEST_F(ViewDeskTest, WhoWaitsForAPictureDelaysNobody) {
  Start();
  auto front = Look("front");
  EXPECT_EQ(client::Call(path_, "GET", "/status", "", test::kBound).status, 200u);
  views_.Show(1);
  EXPECT_EQ(front.get().status, 200u);
}

TEST_F(ViewDeskTest, SaysWhyThereIsNoPicture) {
  Start();
  auto lost = Look("front");
  views_.Show(1, Picture::Outcome::kLost);
  EXPECT_EQ(lost.get().status, 503u);
  auto failed = Look("front");
  views_.Show(1, Picture::Outcome::kFailed);
  const client::ControlReply reply = failed.get();
  EXPECT_EQ(reply.status, 500u);
  EXPECT_THAT(reply.body, HasSubstr("the robot's log says what is missing"));
}

TEST_F(ViewDeskTest, APictureThatDoesNotComeIs503AndALaterOneIsServed) {
  Start({.picture = std::chrono::milliseconds(20)});
  EXPECT_THAT(Look("front").get().body, HasSubstr("no picture came in time"));
  dut_.reset();
  Start();
  auto front = Look("front");
  views_.Show(2);
  EXPECT_EQ(front.get().body, "front");
}

TEST_F(ViewDeskTest, NamesTheCamerasAndTheNearestOne) {
  Start();
  const auto told = nlohmann::json::parse(
      client::Call(path_, "GET", "/cameras", "", test::kBound).body)["cameras"];
  EXPECT_EQ(told[0]["service"], "videohub");
  EXPECT_EQ(told[1]["name"], "head");
  EXPECT_EQ(told[1]["width"], 640);
  EXPECT_EQ(told[0]["depth"], false);
  EXPECT_EQ(told[1]["depth"], true);
  EXPECT_EQ(told[0]["video"]["port"], 1720);
  EXPECT_EQ(told[1]["video"]["sent"], 11);
  EXPECT_EQ(told[1]["video"]["missed"], 3);
  EXPECT_EQ(told[1]["video"]["unsent_packets"], 2);
  const client::ControlReply reply = Look("haed").get();
  EXPECT_EQ(reply.status, 404u);
  EXPECT_THAT(reply.body, HasSubstr("did you mean 'head'?"));
}

TEST_F(ViewDeskTest, EndsWhileSomebodyWaitsForAPicture) {
  Start();
  auto front = Look("front");
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  dut_.reset();
  EXPECT_THROW(front.get(), SetupError);
}

}  // namespace
}  // namespace understudy::server
