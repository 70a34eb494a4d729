// Tests what the host does with calls that are answered with a picture.
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <numeric>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "services/picture_source.h"
#include "services/service_host.h"
#include "tests/services/service_host_fixture.h"

namespace understudy::services {
namespace {

class HandSource : public PictureSource {
 public:
  Order Begin(std::string_view service) noexcept override {
    if (service != "echo") return 0;
    ++begun;
    return shares ? 1 : begun;
  }
  const Picture* Front() const noexcept override { return done.empty() ? nullptr : &done.front(); }
  void Pop() noexcept override { done.pop_front(); }

  std::uint64_t begun = 0;
  bool shares = false;
  std::deque<Picture> done;
};

class ServicePicturesTest : public ServiceHostTest {
 protected:
  ServicePicturesTest() {
    host_.Attach(&source_);
    Listen();
    std::iota(jpeg_.begin(), jpeg_.end(), std::uint8_t{0});
  }

  void Ask(std::int64_t id) {
    const std::uint64_t before = source_.begun;
    Send(id, 11, "");
    ASSERT_TRUE(test::Eventually([&] {
      Poll();
      return source_.begun > before;
    }));
  }
  void Finish(std::uint64_t order, Picture::Outcome outcome) {
    Picture picture{.order = order, .outcome = outcome};
    if (outcome == Picture::Outcome::kDrawn) {
      picture.jpeg = std::make_shared<const std::vector<std::uint8_t>>(jpeg_);
    }
    source_.done.push_back(picture);
  }

  HandSource source_;
  std::vector<std::uint8_t> jpeg_ = std::vector<std::uint8_t>(60'000);  // several datagrams
};

TEST_F(ServicePicturesTest, AnswersWithThePictureOnceItIsDrawnAndServesOthersMeanwhile) {
  Ask(1);
  SendText(2, "x");
  ASSERT_TRUE(Answered(2));
  EXPECT_FALSE(codes_.contains(1));
  Finish(1, Picture::Outcome::kDrawn);
  ASSERT_TRUE(Answered(1));
  EXPECT_EQ(codes_[1], 0);
  EXPECT_EQ(binaries_[1], jpeg_);
  EXPECT_TRUE(binaries_[2].empty());
  ASSERT_EQ(calls_.size(), 2U);
  EXPECT_EQ(calls_[1].name, "Look");
  EXPECT_EQ(calls_[1].code, 0);
  EXPECT_EQ(calls_[1].refusal, CallRefusal::kNone);
}

TEST_F(ServicePicturesTest, GivesCallsOfOneOrderTheSamePicture) {
  source_.shares = true;
  Ask(1);
  Ask(2);
  Finish(1, Picture::Outcome::kDrawn);
  ASSERT_TRUE(Answered(1) && Answered(2));
  EXPECT_EQ(binaries_[1], jpeg_);
  EXPECT_EQ(binaries_[2], jpeg_);
}

TEST_F(ServicePicturesTest, AnswersWithTheServicesCodeWhatCannotBeDrawn) {
  Ask(1);
  Finish(1, Picture::Outcome::kFailed);
  ASSERT_TRUE(Answered(1));
  EXPECT_EQ(codes_[1], 4205);
  EXPECT_TRUE(binaries_[1].empty());
  EXPECT_EQ(Refused(CallRefusal::kFailed), 1U);
}

TEST_F(ServicePicturesTest, DoesNotAnswerForAPictureThatTheCameraLost) {
  Ask(1);
  Finish(1, Picture::Outcome::kLost);
  Ask(2);
  Finish(2, Picture::Outcome::kDrawn);
  ASSERT_TRUE(Answered(2));
  EXPECT_FALSE(codes_.contains(1));
  ASSERT_EQ(calls_.size(), 2U);
  EXPECT_EQ(calls_[0].code, Call::kNoCode);
  EXPECT_EQ(calls_[0].refusal, CallRefusal::kFailed);
}

TEST_F(ServicePicturesTest, GivesUpAPictureThatDoesNotCome) {
  Ask(1);
  now_ += std::chrono::seconds(11);
  ASSERT_TRUE(Answered(1));
  EXPECT_EQ(codes_[1], 4205);
  EXPECT_EQ(Refused(CallRefusal::kFailed), 1U);
}

TEST_F(ServicePicturesTest, OrdersNoneForACallThatWantsNoReply) {
  Send(1, 11, "", {.noreply = true});
  SendText(2, "x");
  ASSERT_TRUE(Answered(2));
  EXPECT_EQ(source_.begun, 0U);
}

TEST_F(ServicePicturesTest, RefusesWhereNoCameraIsThere) {
  host_.Attach(nullptr);
  Send(1, 11, "");
  ASSERT_TRUE(Answered(1));
  EXPECT_EQ(codes_[1], 4205);
  EXPECT_EQ(Refused(CallRefusal::kNotSimulated), 1U);
}

}  // namespace
}  // namespace understudy::services
