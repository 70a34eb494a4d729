#include "remote/terminal_decoder.h"

#include <gtest/gtest.h>

namespace understudy::remote {
namespace {

using Keys = std::vector<TerminalKey>;

Keys Decoded(std::string_view bytes) { return TerminalDecoder().Feed(bytes); }

TEST(TerminalDecoderTest, ReadsWhatEveryTerminalSends) {
  EXPECT_EQ(Decoded("a"), (Keys{{.key = U'a'}}));
  EXPECT_EQ(Decoded("E"), (Keys{{.key = U'e', .shift = true}}));
  EXPECT_EQ(Decoded("\r"), (Keys{{.key = kEnterKey}}));
  EXPECT_EQ(Decoded("\n"), (Keys{{.key = kEnterKey}}));
  EXPECT_EQ(Decoded("\t"), (Keys{{.key = kTabKey}}));
  EXPECT_EQ(Decoded(" 1"), (Keys{{.key = U' '}, {.key = U'1'}}));
  EXPECT_EQ(Decoded("\x03"), (Keys{{.key = U'c', .control = true}}));
}

TEST(TerminalDecoderTest, ReadsArrowsInBothModes) {
  EXPECT_EQ(Decoded("\033[A\033[B\033[C\033[D"),
            (Keys{{.key = kUpKey}, {.key = kDownKey}, {.key = kRightKey}, {.key = kLeftKey}}));
  EXPECT_EQ(Decoded("\033OA\033OD"), (Keys{{.key = kUpKey}, {.key = kLeftKey}}));
  EXPECT_EQ(Decoded("\033[1;2A"), (Keys{{.key = kUpKey, .shift = true}}));
  EXPECT_EQ(Decoded("\033[1;5D"), (Keys{{.key = kLeftKey, .control = true}}));
}

TEST(TerminalDecoderTest, WaitsForTheRestOfASequence) {
  TerminalDecoder decoder;
  for (const char* part : {"\033", "[", "1;", "2"}) {
    EXPECT_TRUE(decoder.Feed(part).empty());
    EXPECT_TRUE(decoder.waits());
  }
  EXPECT_EQ(decoder.Feed("A"), (Keys{{.key = kUpKey, .shift = true}}));
  EXPECT_FALSE(decoder.waits());
}

TEST(TerminalDecoderTest, AnEscapeThatNothingFollowsIsTheKey) {
  TerminalDecoder decoder;
  EXPECT_TRUE(decoder.Feed("\033").empty());
  EXPECT_EQ(decoder.Pause(), (Keys{{.key = kEscapeKey}}));
  EXPECT_FALSE(decoder.waits());
}

TEST(TerminalDecoderTest, ForgetsASequenceThatDoesNotEnd) {
  TerminalDecoder decoder;
  EXPECT_TRUE(decoder.Feed("\033[1;").empty());
  EXPECT_TRUE(decoder.Pause().empty());
  EXPECT_EQ(decoder.Feed("a"), (Keys{{.key = U'a'}}));
  EXPECT_TRUE(decoder.Feed("\033[" + std::string(1000, '1')).empty());
  EXPECT_TRUE(decoder.Pause().empty());
  EXPECT_FALSE(decoder.waits());
  EXPECT_EQ(decoder.Feed("a"), (Keys{{.key = U'a'}}));
}

TEST(TerminalDecoderTest, ASequenceThatIsTooLongIsForgottenAtOnceAsInParts) {
  const std::string bytes = "\033[" + std::string(65, '1') + "Aa";
  TerminalDecoder parts;
  Keys keys;
  for (const char& byte : bytes) {
    const Keys more = parts.Feed({&byte, 1});
    keys.insert(keys.end(), more.begin(), more.end());
  }
  EXPECT_EQ(Decoded(bytes), keys);
}

TEST(TerminalDecoderTest, PassesOverWhatItDoesNotKnow) {
  EXPECT_EQ(Decoded("\033[15~a"), (Keys{{.key = U'a'}}));
  EXPECT_EQ(Decoded("\033[[Aa"), (Keys{{.key = U'a'}}));  // F1 of the Linux console
  EXPECT_EQ(Decoded("\033OPa"), (Keys{{.key = U'a'}}));
  EXPECT_EQ(Decoded("\xc3\xa4\xffz"), (Keys{{.key = U'z'}}));
  EXPECT_TRUE(Decoded("\033[I\033[O\033[97u").empty());
  EXPECT_EQ(Decoded("\033[1;99999999999999999999999A").size(), 1u);
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
