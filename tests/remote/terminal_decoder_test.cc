#include "remote/terminal_decoder.h"

#include <gtest/gtest.h>

namespace understudy::remote {
namespace {

using Kind = TerminalEvent::Kind;
using Events = std::vector<TerminalEvent>;

Events Decoded(std::string_view bytes) { return TerminalDecoder().Feed(bytes); }

TEST(TerminalDecoderTest, ReadsWhatEveryTerminalSends) {
  EXPECT_EQ(Decoded("a"), (Events{{.key = U'a'}}));
  EXPECT_EQ(Decoded("E"), (Events{{.key = U'e', .shift = true}}));
  EXPECT_EQ(Decoded("\r"), (Events{{.key = kEnterKey}}));
  EXPECT_EQ(Decoded("\n"), (Events{{.key = kEnterKey}}));
  EXPECT_EQ(Decoded("\t"), (Events{{.key = kTabKey}}));
  EXPECT_EQ(Decoded(" 1"), (Events{{.key = U' '}, {.key = U'1'}}));
  EXPECT_EQ(Decoded("\x03"), (Events{{.key = U'c', .control = true}}));
}

TEST(TerminalDecoderTest, ReadsArrowsInBothModes) {
  EXPECT_EQ(Decoded("\033[A\033[B\033[C\033[D"),
            (Events{{.key = kUpKey}, {.key = kDownKey}, {.key = kRightKey}, {.key = kLeftKey}}));
  EXPECT_EQ(Decoded("\033OA\033OD"), (Events{{.key = kUpKey}, {.key = kLeftKey}}));
  EXPECT_EQ(Decoded("\033[1;2A"), (Events{{.key = kUpKey, .shift = true}}));
}

TEST(TerminalDecoderTest, ReadsTheKittyProtocol) {
  EXPECT_EQ(Decoded("\033[?11u"), (Events{{.kind = Kind::kReportsReleases}}));
  EXPECT_EQ(Decoded("\033[119u"), (Events{{.key = U'w'}}));
  EXPECT_EQ(Decoded("\033[119;1:1u\033[119;1:2u\033[119;1:3u"),
            (Events{{.key = U'w'},
                    {.kind = Kind::kRepeat, .key = U'w'},
                    {.kind = Kind::kRelease, .key = U'w'}}));
  EXPECT_EQ(Decoded("\033[101:69;2;69u"), (Events{{.key = U'e', .shift = true}}));
  EXPECT_EQ(Decoded("\033[1;1:3B"), (Events{{.kind = Kind::kRelease, .key = kDownKey}}));
  EXPECT_EQ(Decoded("\033[99;5u"), (Events{{.key = U'c', .control = true}}));
  EXPECT_EQ(Decoded("\033[27u"), (Events{{.key = kEscapeKey}}));
  EXPECT_EQ(Decoded("\033[101;129u"), (Events{{.key = U'e'}}));  // num lock
}

TEST(TerminalDecoderTest, BelievesNoTerminalThatReportsNoReleases) {
  EXPECT_TRUE(Decoded("\033[?0u").empty());
  EXPECT_TRUE(Decoded("\033[?1u").empty());
}

TEST(TerminalDecoderTest, SaysWhenTheFocusIsLost) {
  EXPECT_EQ(Decoded("\033[O"), (Events{{.kind = Kind::kFocusLost}}));
  EXPECT_TRUE(Decoded("\033[I").empty());
}

TEST(TerminalDecoderTest, WaitsForTheRestOfASequence) {
  TerminalDecoder decoder;
  for (const char* part : {"\033", "[", "1;1", ":3"}) {
    EXPECT_TRUE(decoder.Feed(part).empty());
    EXPECT_TRUE(decoder.waits());
  }
  EXPECT_EQ(decoder.Feed("A"), (Events{{.kind = Kind::kRelease, .key = kUpKey}}));
  EXPECT_FALSE(decoder.waits());
}

TEST(TerminalDecoderTest, AnEscapeThatNothingFollowsIsTheKey) {
  TerminalDecoder decoder;
  EXPECT_TRUE(decoder.Feed("\033").empty());
  EXPECT_EQ(decoder.Pause(), (Events{{.key = kEscapeKey}}));
  EXPECT_FALSE(decoder.waits());
}

TEST(TerminalDecoderTest, ForgetsASequenceThatDoesNotEnd) {
  TerminalDecoder decoder;
  EXPECT_TRUE(decoder.Feed("\033[1;").empty());
  EXPECT_TRUE(decoder.Pause().empty());
  EXPECT_EQ(decoder.Feed("a"), (Events{{.key = U'a'}}));
  EXPECT_TRUE(decoder.Feed("\033[" + std::string(1000, '1')).empty());
  EXPECT_FALSE(decoder.waits());
}

TEST(TerminalDecoderTest, PassesOverWhatItDoesNotKnow) {
  EXPECT_EQ(Decoded("\033[15~a"), (Events{{.key = U'a'}}));
  EXPECT_EQ(Decoded("\033[[Aa"), (Events{{.key = U'a'}}));  // F1 of the Linux console
  EXPECT_EQ(Decoded("\033OPa"), (Events{{.key = U'a'}}));
  EXPECT_EQ(Decoded("\xc3\xa4\xffz"), (Events{{.key = U'z'}}));
  EXPECT_EQ(Decoded("\033[99999999999999999999999;99999999999:99999999999u").size(), 1u);
}

TEST(TerminalDecoderTest, SurvivesAnyBytes) {
  TerminalDecoder decoder;
  unsigned state = 1;
  for (int i = 0; i < 100'000; ++i) {
    state = state * 1664525 + 1013904223;
    const char alphabet[] = "\033\033[[OO?;:0123u~ABa\x03\xff";
    const char byte = alphabet[(state >> 16) % (sizeof alphabet - 1)];
    decoder.Feed({&byte, 1});
    if (state % 97 == 0) decoder.Pause();
  }
  decoder.Pause();
  EXPECT_FALSE(decoder.waits());
}

}  // namespace
}  // namespace understudy::remote
